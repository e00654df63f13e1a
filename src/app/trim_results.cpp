#include "app/trim_results.h"

#include <algorithm>
#include <numbers>

#include "base/errors.h"
#include "io/results.h"

namespace windhover::app {
namespace {

using coupling::Equilibrium;

bool is_motion(const std::string& name) {
  return std::find(body::kFreedomNames.begin(), body::kFreedomNames.end(), name) != body::kFreedomNames.end();
}
bool is_rotation(const std::string& name) { return name.starts_with("rotation_"); }

/// y_m, rotation_z_deg, rotor_R_rpm
std::string unknown_column(const std::string& name) {
  if (!is_motion(name)) return "rotor_" + name + "_rpm";
  return name + (is_rotation(name) ? "_deg" : "_m");
}
double in_unit_of_column(const std::string& name, double value) {
  if (!is_motion(name)) return value * 30 / std::numbers::pi;
  return is_rotation(name) ? value * 180 / std::numbers::pi : value;
}

std::vector<std::string> unknown_columns(const Equilibrium& equilibrium) {
  std::vector<std::string> columns;
  for (const auto& name : equilibrium.unknowns()) columns.push_back(unknown_column(name));
  return columns;
}
std::vector<std::string> balance_columns(const Equilibrium& equilibrium) {
  std::vector<std::string> columns;
  for (const auto& name : equilibrium.balanced())
    columns.push_back("left_" + name + (is_rotation(name) ? "_Nm" : "_N"));
  return columns;
}

std::vector<std::string> all_columns(const Equilibrium& equilibrium) {
  std::vector<std::string> columns = {"step", "time_s", "try", "windows", "settled", "residual", "change", "wall_s"};
  for (const auto& part : {unknown_columns(equilibrium), balance_columns(equilibrium)})
    columns.insert(columns.end(), part.begin(), part.end());
  return columns;
}
constexpr size_t kFirstUnknown = 8;

}  // namespace

TrimResults::TrimResults(const Case& c, const Run& run, const Equilibrium& equilibrium)
    : case_(c),
      started_(MPI_Wtime()),
      unknown_columns_(unknown_columns(equilibrium)),
      balance_columns_(balance_columns(equilibrium)),
      table_(run.directory() / "trim.csv", all_columns(equilibrium), run.comm()) {}

void TrimResults::tell(const Run& run, const Try& t) const {
  const std::string change = t.windows > 1 ? fmt::format(", means change by {:.2g}", t.change) : "";
  petsc(PetscPrintf(run.comm(), "%s",
                    fmt::format("try {}, window {} to {:.6g} s: {:.3g} left{}\n", t.number, t.windows, run.time_s(),
                                t.residual, change)
                        .c_str()));
}

void TrimResults::add(Run& run, const Equilibrium& equilibrium, const coupling::Hold& hold, const Try& t) {
  const fluid::FlowState& state = run.solver().state();
  last_row_ = {double(state.step), run.time_s(), double(t.number), double(t.windows),
               double(t.settled),  t.residual,   t.change,         t.wall_s};
  const coupling::VectorXd values = equilibrium.values(hold);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    last_row_.push_back(in_unit_of_column(equilibrium.unknowns()[i], values[i]));
  last_row_.insert(last_row_.end(), t.left.begin(), t.left.end());
  table_.append(last_row_);
  windows_ += t.windows;
}

void TrimResults::finish(const Run& run, HeldFlight& held, const coupling::BalanceResult& balance) {
  nlohmann::ordered_json j;
  j["case"] = case_.name;
  j["converged"] = balance.converged;
  if (!balance.converged) j["reason"] = balance.stopped ? "interrupted" : balance.reason;
  j["tries"] = balance.evaluations;
  j["windows"] = windows_;
  j["wall_s"] = MPI_Wtime() - started_;
  std::string text = balance.converged ? fmt::format("balance after {} tries:\n", balance.evaluations) : "";
  if (!last_row_.empty()) {
    j["residual"] = last_row_[5];
    j["change"] = last_row_[6];
    for (size_t i = 0; i < unknown_columns_.size() + balance_columns_.size(); ++i) {
      const bool sought = i < unknown_columns_.size();
      const std::string& name = sought ? unknown_columns_[i] : balance_columns_[i - unknown_columns_.size()];
      j[sought ? "unknowns" : "left"][name] = last_row_[kFirstUnknown + i];
      if (balance.converged && sought) text += fmt::format("  {:24} {:.6g}\n", name, last_row_[kFirstUnknown + i]);
    }
  }
  const HeldFlight::Control control = held.control();
  j["controller"] = {{"speed_error", control.speed_error}, {"state_rate", control.state_rate}};
  constexpr double kNoticeable = 1e-3;
  if (balance.converged && control.speed_error > kNoticeable)
    text +=
        fmt::format("the controller commands speeds that differ by {:.2g} of these: a run from here will not stay\n",
                    control.speed_error);
  io::write_json(run.directory() / "trim.json", j, run.comm());
  petsc(PetscPrintf(run.comm(), "%s", text.c_str()));
}

}  // namespace windhover::app
