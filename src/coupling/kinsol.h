// What the uses of KINSOL share.
#pragma once
#include <kinsol/kinsol.h>

#include <Eigen/Core>
#include <string>

#include "base/sundials.h"

namespace windhover::coupling {

using Kinsol = std::unique_ptr<void, sundials::ReleaseMemory<KINFree>>;

inline Eigen::Map<Eigen::VectorXd> values(N_Vector v) { return {N_VGetArrayPointer(v), NV_LENGTH_S(v)}; }

inline void check(int flag) {
  if (flag < 0) throw std::runtime_error(std::string("KINSOL: ") + KINGetReturnFlagName(flag));
}

}  // namespace windhover::coupling
