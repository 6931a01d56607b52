#include "step_work.hpp"

#include "scree/parallel/executor.hpp"
#include "surface_motion.hpp"

namespace scree::dvi {

namespace {

constexpr std::size_t kGrain = 2048;

/// One step's velocities, body by body.
class Velocities {
 public:
  explicit Velocities(const FreeMotion& motion) : motion_{motion} {}

  /// v0; of a body that forces do not move, what it is told.
  [[nodiscard]] Twist begin(BodyIndex i) const {
    if (motion_.bodies.motion[i] != Motion::dynamic) return free(i);
    return {motion_.bodies.velocity[i], motion_.bodies.angular_velocity[i]};
  }
  [[nodiscard]] Twist free(BodyIndex i) const { return {motion_.velocity[i], motion_.angular_velocity[i]}; }
  /// The same of a body that forces do not move; zero of others.
  [[nodiscard]] Twist told(BodyIndex i) const {
    return motion_.bodies.motion[i] == Motion::dynamic ? Twist{} : free(i);
  }
  /// M (v_f - v0) . v, the work of h f at the velocity v [J].
  [[nodiscard]] double force_work(BodyIndex i, const Twist& v) const {
    const BodyView& bodies = motion_.bodies;
    if (bodies.motion[i] != Motion::dynamic) return 0.0;
    const Twist from = begin(i), to = free(i);
    double work = bodies.mass[i] * dot(to.linear - from.linear, v.linear);
    if (to.angular == from.angular) return work;
    const Quat& q = bodies.orientation[i];
    const Vec3 moment = hadamard(bodies.inertia[i], rotate_back(q, to.angular - from.angular));
    return work + dot(moment, rotate_back(q, v.angular));
  }

 private:
  const FreeMotion& motion_;
};

Twist mean(const Twist& a, const Twist& b) { return {0.5 * (a.linear + b.linear), 0.5 * (a.angular + b.angular)}; }

/// What contact k does: gamma . u at the velocities `a` and `b` of its bodies [J].
double contact_work(const ContactAssembly& assembly, const StepAnswer& answer, std::size_t k, const Twist& a,
                    const Twist& b) {
  const CcpContact& c = assembly.geometry(k);
  const double work = dot(answer.impulse[k], relative_velocity(c, a, b));
  if (assembly.rolling(k) == nullptr) return work;
  return work + dot(answer.angular_impulse[k], in_frame(c, b.angular - a.angular));
}

/// The same for the motion of the surfaces against their bodies [J].
double surface_work(const BodyView& bodies, const ContactAssembly& assembly, const StepAnswer& answer, std::size_t k) {
  if (bodies.surface_motion.empty()) return 0.0;
  const Contact& found = assembly.contacts()[k];
  const CcpContact& c = assembly.geometry(k);
  const double work = dot(answer.impulse[k], surface_slip(bodies, found, c));
  if (assembly.rolling(k) == nullptr) return work;
  const Vec3 turning = surface_motion(bodies, found.b).angular - surface_motion(bodies, found.a).angular;
  return work + dot(answer.angular_impulse[k], in_frame(c, turning));
}

/// Sum of of(i, out) over 0 <= i < count, chunk by chunk.
template <class Of>
StepWork sum(std::size_t count, const Executor& executor, std::vector<StepWork>& partial, const Of& of) {
  partial.assign(Executor::chunk_count(count, kGrain), {});
  executor.for_chunks(count, kGrain, [&](std::size_t first, std::size_t last) {
    StepWork here;
    for (std::size_t i = first; i < last; ++i) of(i, here);
    partial[first / kGrain] = here;
  });
  StepWork total;
  for (const StepWork& part : partial) total += part;
  return total;
}

}  // namespace

StepWork step_work(const FreeMotion& motion, const ContactAssembly& assembly, const StepAnswer& answer,
                   const Executor& executor, std::vector<StepWork>& partial) {
  const Velocities v{motion};
  StepWork total = sum(motion.velocity.size(), executor, partial, [&](std::size_t i, StepWork& out) {
    const auto body = static_cast<BodyIndex>(i);
    out.force_work += v.force_work(body, mean(v.begin(body), v.free(body)));
  });
  const std::span<const BodyIndex> bodies = assembly.bodies();
  total += sum(answer.w.size(), executor, partial,
               [&](std::size_t k, StepWork& out) { out.force_work += 0.5 * v.force_work(bodies[k], answer.w[k]); });
  const std::span<const Contact> contacts = assembly.contacts();
  total += sum(contacts.size(), executor, partial, [&](std::size_t k, StepWork& out) {
    const BodyIndex a = contacts[k].a, b = contacts[k].b;
    const CcpContact& c = assembly.geometry(k);
    const auto middle = [&](BodyIndex i, std::uint32_t number) {
      const Twist end = {motion.velocity[i] + answer.w[number].linear,
                         motion.angular_velocity[i] + answer.w[number].angular};
      return mean(v.begin(i), end);
    };
    const double surfaces = surface_work(motion.bodies, assembly, answer, k);
    out.contact_loss -= contact_work(assembly, answer, k, middle(a, c.a), middle(b, c.b)) + surfaces;
    out.boundary_work -= contact_work(assembly, answer, k, v.told(a), v.told(b)) + surfaces;
  });
  return total;
}

}  // namespace scree::dvi
