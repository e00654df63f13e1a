#include "fluid/flux_roe.h"

#include "fluid/flux_kernels.h"

namespace windhover::fluid {

const FluxKernels kRoeKernels = make_flux_kernels<Roe>("roe", false);

}  // namespace windhover::fluid
