#include "fluid/flux_hllc.h"

#include "fluid/flux_kernels.h"

namespace windhover::fluid {

const FluxKernels kHllcKernels = make_flux_kernels<Hllc>("hllc", false);

}  // namespace windhover::fluid
