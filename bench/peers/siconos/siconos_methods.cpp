#include "siconos_methods.hpp"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <GlobalFrictionContactProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>

#include "scree/base/error.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/guess.hpp"
#include "siconos_declared.hpp"

namespace scree {
namespace {

using Form = SiconosMethod::Form;
using Options = std::unique_ptr<SolverOptions, void (*)(SolverOptions*)>;

constexpr std::array kMethods{
    SiconosMethod{"admm", Form::local, SICONOS_FRICTION_3D_ADMM, true, "ADMM"},
    SiconosMethod{"soclcp_nsgs", Form::second_order_cone, kSoclcpNsgs, false,
                  "cone by cone, what SICONOS_FRICTION_3D_SOCLCP calls"},
    SiconosMethod{"soclcp_vi_fpp", Form::second_order_cone, kSoclcpFixedPoint, false,
                  "fixed point projection on the inequality"},
    SiconosMethod{"soclcp_vi_eg", Form::second_order_cone, kSoclcpExtraGradient, false,
                  "extra-gradient on the inequality"},
    SiconosMethod{"convexqp_pg", Form::convex_qp, kConvexQpGradient, false, "projected gradient with line search"},
    SiconosMethod{"convexqp_admm", Form::convex_qp, kConvexQpAdmm, false, "ADMM for any convex set"},
    SiconosMethod{"global_admm", Form::global, SICONOS_GLOBAL_FRICTION_3D_ADMM, false,
                  "ADMM with masses, without the update of s"},
    SiconosMethod{"global_ipm", Form::global, SICONOS_GLOBAL_FRICTION_3D_IPM, false, "interior point with masses"},
    SiconosMethod{"nsgs", Form::local, SICONOS_FRICTION_3D_NSGS, true, "contact by contact"},
    SiconosMethod{"aclmfp", Form::local, SICONOS_FRICTION_3D_ACLMFP, true, "a row of convex problems"},
    SiconosMethod{"tfp", Form::local, SICONOS_FRICTION_3D_TFP, true,
                  "a row of problems with given bounds of friction (Tresca)"},
    SiconosMethod{"vi_fpp", Form::local, SICONOS_FRICTION_3D_VI_FPP, true, "fixed point projection on the inequality"},
    SiconosMethod{"vi_eg", Form::local, SICONOS_FRICTION_3D_VI_EG, true, "extra-gradient on the inequality"},
    SiconosMethod{"nsn_ac", Form::local, SICONOS_FRICTION_3D_NSN_AC, true, "semi-smooth Newton, Alart and Curnier"},
};

// The product of the cones, for a ConvexQP whose env is a LocalForm.
void project_on_cones(void* self, double* x, double* projected) {
  const auto& friction = static_cast<const LocalForm*>(static_cast<ConvexQP*>(self)->env)->friction;
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const Vec3 p = project_cone3({x[3 * i], x[3 * i + 1], x[3 * i + 2]}, friction[i]);
    projected[3 * i] = p.x, projected[3 * i + 1] = p.y, projected[3 * i + 2] = p.z;
  }
}

// Contacts whose cones Siconos calls by their first rows.
std::vector<unsigned> first_rows(std::size_t contacts) {
  std::vector<unsigned> out(contacts + 1);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<unsigned>(3 * i);
  return out;
}

void solve_local(LocalForm& form, double* gamma, double* u, SolverOptions* options) {
  FrictionContactProblem problem{3, static_cast<int>(form.friction.size()), form.w.get(), form.q.data(),
                                 form.friction.data()};
  fc3d_driver(&problem, gamma, u, options);
}

void solve_second_order_cone(LocalForm& form, double* gamma, double* u, SolverOptions* options) {
  std::vector<unsigned> first = first_rows(form.friction.size());
  SecondOrderConeLinearComplementarityProblem problem{static_cast<int>(form.q.size()),
                                                      static_cast<int>(form.friction.size()),
                                                      form.w.get(),
                                                      form.q.data(),
                                                      first.data(),
                                                      form.friction.data()};
  soclcp_driver(&problem, gamma, u, options);
}

void solve_convex_qp(LocalForm& form, double* gamma, double* u, SolverOptions* options) {
  const int size = static_cast<int>(form.q.size());
  NumericsMatrixPtr identity{NM_eye(size)};
  std::vector<double> zero(form.q.size()), xi(form.q.size()), image(form.q.size());
  const bool admm = options->solverId == kConvexQpAdmm;
  ConvexQP problem{size,
                   size,
                   &form,
                   form.w.get(),
                   form.q.data(),
                   admm ? identity.get() : nullptr,
                   admm ? zero.data() : nullptr,
                   project_on_cones,
                   0.0,
                   0};
  int info = 0;
  if (admm) {
    convexQP_ADMM(&problem, gamma, u, xi.data(), image.data(), &info, options);
  } else {
    convexQP_ProjectedGradient(&problem, gamma, u, &info, options);
  }
}

void solve_global(GlobalForm& form, double* gamma, double* u, SolverOptions* options) {
  std::vector<double> v(form.q.size());
  GlobalFrictionContactProblem problem{};
  problem.dimension = 3;
  problem.numberOfContacts = static_cast<int>(form.friction.size());
  problem.M = form.m.get();
  problem.H = form.h.get();
  problem.q = form.q.data();
  problem.b = form.b.data();
  problem.mu = form.friction.data();
  gfc3d_driver(&problem, gamma, u, v.data(), options);
}

}  // namespace

std::span<const SiconosMethod> siconos_methods() { return kMethods; }

const SiconosMethod& siconos_method(std::string_view name) {
  const auto found = std::ranges::find(kMethods, name, &SiconosMethod::name);
  if (found != kMethods.end()) return *found;
  std::string valid;
  for (const SiconosMethod& method : kMethods) valid += (valid.empty() ? "" : ", ") + std::string{method.name};
  throw Error{ErrorKind::usage, "there is no method '" + std::string{name} + "'; valid: " + valid};
}

SiconosSolver::SiconosSolver(const SiconosMethod& method, const CcpProblem& problem)
    : method_{method}, problem_{problem} {
  if (method.form == Form::global) {
    global_.emplace(problem);
  } else {
    local_.emplace(problem);
  }
}

SiconosAnswer SiconosSolver::solve(double tolerance, int max_iterations) {
  const Options options{solver_options_create(method_.solver), solver_options_delete};
  options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  if (method_.solver == SICONOS_GLOBAL_FRICTION_3D_ADMM) {
    options->iparam[SICONOS_FRICTION_3D_ADMM_IPARAM_UPDATE_S] = SICONOS_FRICTION_3D_ADMM_UPDATE_S_NO;
  }
  SiconosAnswer answer{std::vector<double>(problem_.rows(), 0.0)};
  std::vector<double> u(problem_.rows(), 0.0);
  const auto start = std::chrono::steady_clock::now();
  switch (method_.form) {
    case Form::local:
      solve_local(*local_, answer.gamma.data(), u.data(), options.get());
      break;
    case Form::second_order_cone:
      solve_second_order_cone(*local_, answer.gamma.data(), u.data(), options.get());
      break;
    case Form::convex_qp:
      solve_convex_qp(*local_, answer.gamma.data(), u.data(), options.get());
      break;
    case Form::global:
      solve_global(*global_, answer.gamma.data(), u.data(), options.get());
      break;
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  answer.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  project_guess(problem_, answer.gamma);
  return answer;
}

}  // namespace scree
