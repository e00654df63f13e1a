// What a trim tells and writes: a line per window, a row of trim.csv per try, trim.json.
#pragma once
#include "app/held_flight.h"
#include "app/run.h"
#include "io/csv.h"

namespace windhover::app {

/// One try of a trim.
struct Try {
  int number = 0, windows = 0;
  bool settled = false;             ///< the means
  double residual = 0, change = 0;  ///< largest scaled mean that is left, and its change over the last window
  coupling::VectorXd left = {};     ///< N, N m
  double wall_s = 0;
};

class TrimResults {
 public:
  TrimResults(const Case& c, const Run& run, const coupling::Equilibrium& equilibrium);

  /// After each window.
  void tell(const Run& run, const Try& t) const;
  /// After each try.
  void add(Run& run, const coupling::Equilibrium& equilibrium, const coupling::Hold& hold, const Try& t);
  void finish(const Run& run, HeldFlight& held, const coupling::BalanceResult& balance);

 private:
  const Case& case_;
  double started_;
  std::vector<std::string> unknown_columns_, balance_columns_;
  io::CsvTable table_;
  std::vector<double> last_row_;
  int windows_ = 0;
};

}  // namespace windhover::app
