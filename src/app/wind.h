// Wind that changes in time.
#pragma once
#include "app/case.h"

namespace windhover::app {

/// What the changes of the wind have added to its velocity at a time (s): m/s, inertial axes.
Vec3 wind_change(const WindOptions& wind, double t);

/// By how much the wind (m/s, inertial axes) is not that of time.start_from; zero when there is no such folder.
Vec3 wind_jump(const Case& c);

/// The first time (s) after t at which the wind begins or ceases to change; infinite when there is none.
double next_wind_change(const WindOptions& wind, double t);

}  // namespace windhover::app
