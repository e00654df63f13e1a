#include "app/simulation.h"

#include "base/errors.h"

namespace windhover::app {

int run_simulation(const Case&, const RunOptions&) { throw SolverFailure("not built yet"); }

int check_simulation(const Case&) { throw SolverFailure("not built yet"); }

}  // namespace windhover::app
