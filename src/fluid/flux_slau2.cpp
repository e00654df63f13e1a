#include "fluid/flux_slau2.h"

#include "fluid/flux_kernels.h"

namespace windhover::fluid {

const FluxKernels kSlau2Kernels = make_flux_kernels<Slau2>("slau2", true);

}  // namespace windhover::fluid
