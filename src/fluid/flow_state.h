// The flow at the present time and what went before.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// All that the next step depends on.
struct FlowState {
  VecHandle q;         ///< conserved variables at `time`
  VecHandle previous;  ///< one accepted step earlier
  VecHandle earlier;   ///< one step before `previous`; none where nobody asks for it
  VecHandle remainder;  ///< F of the last step over its factor of R(q), what is to be taken out of R(q); none where nobody asks for it
  double time = 0;
  double last_step = 0;  ///< time since `previous`; 0: there is none
  double step_before = 0;  ///< time from `earlier` to `previous`; 0: there is none
  double third = 0;      ///< |V d³q/dt³| as estimated in the last step, 2-norm; 0: unknown or not asked for
  long step = 0;
};

}  // namespace windhover::fluid
