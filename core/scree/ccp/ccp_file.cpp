#include "scree/ccp/ccp_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/state/hdf5_checkpoint.hpp"

namespace scree {
namespace {

const StateContent kContent{"contact problem", "ccp_100.h5"};

// Directions of a file of other software may be rounded to single precision.
constexpr double kDirectionError = 1e-6;

static_assert(sizeof(Mat3) == 9 * sizeof(double));

/// Says what does not fit, and where.
class Judgement {
 public:
  explicit Judgement(const std::string& place) : place_{place} {}

  void require(bool good, const std::string& sentence) const {
    if (!good) throw Error{ErrorKind::io, place_ + " cannot be used: " + sentence + "."};
  }
  void size(const char* name, std::size_t found, std::size_t wanted, const std::string& reason) const {
    require(found == wanted, "\"" + std::string{name} + "\" has " + std::to_string(found) + " entries instead of " +
                                 std::to_string(wanted) + ", " + reason);
  }
  void finite(const char* name, std::span<const double> values) const {
    every(
        name, values, [](double value) { return std::isfinite(value); }, "is not a finite number");
  }
  void not_negative(const char* name, std::span<const double> values) const {
    every(
        name, values, [](double value) { return value >= 0.0; }, "is negative");
  }

 private:
  template <class Good>
  void every(const char* name, std::span<const double> values, const Good& good, const char* what) const {
    const auto bad = std::find_if_not(values.begin(), values.end(), good);
    if (bad == values.end()) return;
    require(false, "entry " + std::to_string(bad - values.begin()) + " of \"" + name + "\" " + what);
  }
  const std::string& place_;
};

void check_bodies(const CcpRecord& record, const Judgement& judgement) {
  const std::size_t n = record.inverse_mass.size();
  judgement.size("inverse_inertia", record.inverse_inertia.size(), n, "one matrix a body");
  judgement.finite("inverse_mass", record.inverse_mass);
  judgement.not_negative("inverse_mass", record.inverse_mass);
  for (std::size_t k = 0; k < n; ++k) {
    const Mat3& j = record.inverse_inertia[k];
    const std::string body = "the inverse inertia of body " + std::to_string(k);
    judgement.require(is_finite(j.row0) && is_finite(j.row1) && is_finite(j.row2), body + " is not finite");
    const double trace = j.row0.x + j.row1.y + j.row2.z;
    const double skewness =
        std::max({std::abs(j.row0.y - j.row1.x), std::abs(j.row0.z - j.row2.x), std::abs(j.row1.z - j.row2.y)});
    judgement.require(std::min({j.row0.x, j.row1.y, j.row2.z}) >= 0.0, body + " has a negative diagonal");
    judgement.require(skewness <= kDirectionError * trace, body + " is not symmetric");
  }
}

void check_contact(const CcpRecord& record, std::size_t i, const Judgement& judgement) {
  const CcpContact& c = record.contacts[i];
  const std::string contact = "contact " + std::to_string(i);
  const std::size_t n = record.inverse_mass.size();
  for (const std::uint32_t body : {c.a, c.b}) {
    judgement.require(body < n, contact + " is on body " + std::to_string(body) + ", but there are only " +
                                    std::to_string(n) + " bodies, counted from 0");
  }
  judgement.require(is_finite(c.normal) && is_finite(c.tangent1) && is_finite(c.arm_a) && is_finite(c.arm_b) &&
                        std::isfinite(c.friction),
                    contact + " has a number that is not finite");
  judgement.require(c.friction >= 0.0, contact + " has a negative coefficient of friction");
  judgement.require(std::abs(norm(c.normal) - 1.0) <= kDirectionError &&
                        std::abs(norm(c.tangent1) - 1.0) <= kDirectionError &&
                        std::abs(dot(c.normal, c.tangent1)) <= kDirectionError,
                    contact + " has a normal and a tangent that are not perpendicular unit vectors");
}

/// One member of every contact.
std::vector<Vec3> column(const CcpRecord& record, Vec3 CcpContact::*member) {
  std::vector<Vec3> values;
  values.reserve(record.contacts.size());
  for (const CcpContact& c : record.contacts) values.push_back(c.*member);
  return values;
}
std::vector<std::uint64_t> column(const CcpRecord& record, std::uint32_t CcpContact::*member) {
  std::vector<std::uint64_t> values;
  values.reserve(record.contacts.size());
  for (const CcpContact& c : record.contacts) values.push_back(c.*member);
  return values;
}

/// Reads the columns of the contacts, all of one length.
std::vector<CcpContact> read_contacts(const StateReader& in, const Judgement& judgement) {
  const std::vector<double> friction = in.doubles("friction");
  std::vector<CcpContact> contacts(friction.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].friction = friction[i];
  const auto vectors = [&](const char* name, Vec3 CcpContact::*member) {
    const std::vector<double> flat = in.doubles(name);
    judgement.size(name, flat.size(), 3 * contacts.size(), "three a contact");
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      contacts[i].*member = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    }
  };
  const auto indices = [&](const char* name, std::uint32_t CcpContact::*member) {
    const std::vector<std::uint64_t> values = in.integers(name);
    judgement.size(name, values.size(), contacts.size(), "one a contact");
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      constexpr std::uint64_t kGreatest = std::numeric_limits<std::uint32_t>::max();
      contacts[i].*member = static_cast<std::uint32_t>(std::min(values[i], kGreatest));
    }
  };
  vectors("normal", &CcpContact::normal);
  vectors("tangent1", &CcpContact::tangent1);
  vectors("arm_a", &CcpContact::arm_a);
  vectors("arm_b", &CcpContact::arm_b);
  indices("body_a", &CcpContact::a);
  indices("body_b", &CcpContact::b);
  return contacts;
}

std::vector<Mat3> read_inertias(const StateReader& in, std::size_t bodies, const Judgement& judgement) {
  const std::vector<double> flat = in.doubles("inverse_inertia");
  judgement.size("inverse_inertia", flat.size(), 9 * bodies, "nine a body");
  std::vector<Mat3> values(bodies);
  for (std::size_t k = 0; k < bodies; ++k) {
    const double* j = flat.data() + 9 * k;
    values[k] = {{j[0], j[1], j[2]}, {j[3], j[4], j[5]}, {j[6], j[7], j[8]}};
  }
  return values;
}

}  // namespace

CcpRecord make_ccp_record(const CcpProblem& problem, std::span<const double> guess, CcpOrigin origin) {
  return {{problem.inverse_mass.begin(), problem.inverse_mass.end()},
          {problem.inverse_inertia.begin(), problem.inverse_inertia.end()},
          {problem.contacts.begin(), problem.contacts.end()},
          {problem.r.begin(), problem.r.end()},
          {problem.compliance.begin(), problem.compliance.end()},
          {guess.begin(), guess.end()},
          std::move(origin)};
}

void check_ccp_record(const CcpRecord& record, const std::string& place) {
  const Judgement judgement{place};
  const std::size_t rows = 3 * record.contacts.size();
  check_bodies(record, judgement);
  judgement.size("r", record.r.size(), rows, "three a contact");
  judgement.size("guess", record.guess.size(), rows, "three a contact");
  if (!record.compliance.empty()) {
    judgement.size("compliance", record.compliance.size(), rows, "three a contact or none at all");
  }
  for (std::size_t i = 0; i < record.contacts.size(); ++i) check_contact(record, i, judgement);
  judgement.finite("r", record.r);
  judgement.finite("guess", record.guess);
  judgement.finite("compliance", record.compliance);
  judgement.not_negative("compliance", record.compliance);
  judgement.require(std::isfinite(record.origin.tolerance) && record.origin.tolerance >= 0.0,
                    "\"tolerance\" is not a number from 0 on");
  judgement.require(record.origin.max_iterations >= 1, "\"max_iterations\" is not a number from 1 on");
}

void write_ccp_file(const std::filesystem::path& file, const CcpRecord& record) {
  CheckpointWriter writer{{record.origin.scene_hash, record.origin.scree_version}, kContent};
  StateWriter& out = writer.root();
  std::vector<double> friction;
  for (const CcpContact& c : record.contacts) friction.push_back(c.friction);
  out.write("inverse_mass", record.inverse_mass);
  out.write("inverse_inertia", std::span{reinterpret_cast<const double*>(record.inverse_inertia.data()),
                                         9 * record.inverse_inertia.size()});
  out.write("normal", column(record, &CcpContact::normal));
  out.write("tangent1", column(record, &CcpContact::tangent1));
  out.write("arm_a", column(record, &CcpContact::arm_a));
  out.write("arm_b", column(record, &CcpContact::arm_b));
  out.write("friction", friction);
  out.write("body_a", column(record, &CcpContact::a));
  out.write("body_b", column(record, &CcpContact::b));
  out.write("r", record.r);
  out.write("compliance", record.compliance);
  out.write("guess", record.guess);
  out.write("time", record.origin.time);
  out.write("step", record.origin.step);
  out.write("tolerance", record.origin.tolerance);
  out.write("max_iterations", static_cast<std::uint64_t>(record.origin.max_iterations));
  writer.save_as(file);
}

CcpRecord read_ccp_file(const std::filesystem::path& file) {
  const CheckpointReader reader{file, kContent};
  const StateReader& in = reader.root();
  const std::string place = "the contact problem " + file.string();
  const Judgement judgement{place};
  CcpRecord record;
  record.inverse_mass = in.doubles("inverse_mass");
  record.inverse_inertia = read_inertias(in, record.inverse_mass.size(), judgement);
  record.contacts = read_contacts(in, judgement);
  record.r = in.doubles("r");
  record.compliance = in.doubles("compliance");
  record.guess = in.doubles("guess");
  constexpr std::uint64_t kGreatest = std::numeric_limits<int>::max();
  record.origin = {reader.header().scene_hash, reader.header().scree_version,
                   in.number("time"),          in.integer("step"),
                   in.number("tolerance"),     static_cast<int>(std::min(in.integer("max_iterations"), kGreatest))};
  check_ccp_record(record, place);
  return record;
}

}  // namespace scree
