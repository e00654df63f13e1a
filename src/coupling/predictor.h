// First guess of the loads at the end of a step from those of the steps before.
#pragma once
#include <span>

#include "body/loads.h"
#include "coupling/schemes.h"

namespace windhover::coupling {

/// Most loads that a prediction looks back at.
constexpr int kKeptLoads = 4;

/// `known`: in order of time, the latest last; `scale` makes components comparable. Extrapolation is linear. `best` is,
/// of linear, quadratic and the one that is exact for lines with a 2Δt oscillation (which Crank–Nicolson does not damp),
/// the one that would have predicted the latest loads best; it needs four loads at equal steps and is linear before.
VectorXd predict(Prediction prediction, std::span<const body::LoadPolynomial::Point> known, double end,
                 const VectorXd& scale);

}  // namespace windhover::coupling
