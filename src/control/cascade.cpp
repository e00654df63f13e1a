#include "control/cascade.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "control/mixer.h"

namespace windhover::control {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kLeastLift = 0.2;  ///< of gravity: thrust never points down, so that the attitude stays defined

/// Offsets of the states: acceleration (W), angular acceleration (B), filtered angular velocity (B).
enum : int { kVelocityIntegral = 0, kRateIntegral = 3, kRateFilter = 6, kStateSize = 9 };

/// The attitude whose y axis is along `thrust` and whose x axis heads towards `yaw`.
Mat3 attitude_for(const Vec3& thrust, double yaw) {
  const Vec3 heading(std::cos(yaw), 0, -std::sin(yaw));
  Mat3 R;
  R.col(1) = thrust.normalized();
  R.col(2) = heading.cross(R.col(1)).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

/// Twice the vector part of the quaternion: near the rotation vector, and bounded.
Vec3 rotation_error(const Mat3& R_BD) {
  const Eigen::Quaterniond q(R_BD);
  return (q.w() < 0 ? -2 : 2) * q.vec();
}

class Cascade : public Controller {
 public:
  Cascade(const CascadeOptions& options, const Airframe& airframe, const std::string& prefix)
      : options_(options),
        airframe_(airframe),
        inverse_inertia_(airframe.inertia_BG_B.inverse()),
        mixer_(airframe.rotors, options.torque_reserve, prefix + "mixer") {}

  int state_size() const override { return kStateSize; }

  Command evaluate(const Measurement& m, const Setpoint& setpoint, std::span<const double> state,
                   std::span<double> rate) const override {
    const auto in = [&](int offset) { return Vec3(Vec3::Map(&state[offset])); };
    const auto out = [&](int offset) { return Vec3::Map(&rate[offset]); };
    const CascadeOptions& o = options_;

    // Position and velocity: an acceleration, and the specific force that gives it within the limits.
    const Vec3 velocity_error = this->velocity_error(m, setpoint);
    const Vec3 acceleration = o.velocity_gain_1_s.cwiseProduct(velocity_error) + in(kVelocityIntegral);
    const Vec3 weight = Vec3::UnitY() * airframe_.gravity;
    const Vec3 specific_force = limited(acceleration + weight);

    // Attitude: an angular velocity, an angular acceleration, and the torque that gives it.
    const Vec3& omega = m.omega_WB_B;
    const Vec3 rate_error = this->rate_error(m, setpoint, specific_force);
    const Vec3 filtered_acceleration = (omega - in(kRateFilter)) / o.rate_filter_s;
    const Vec3 angular_acceleration = o.rate_gain_1_s.cwiseProduct(rate_error) +
                                      in(kRateIntegral)-o.rate_derivative.cwiseProduct(filtered_acceleration);
    const Mat3& inertia = airframe_.inertia_BG_B;
    const Vec3 up = m.R_WB.col(1);
    const Wrench demand{airframe_.mass * specific_force.dot(up),
                        inertia * angular_acceleration + omega.cross(inertia * omega)};
    const Allocation allocation = mixer_.allocate(demand);

    // Integrators give way by what the limits took.
    const Vec3 lost_acceleration =
        specific_force - weight - acceleration + up * (allocation.achieved.thrust - demand.thrust) / airframe_.mass;
    const Vec3 lost_angular_acceleration = inverse_inertia_ * (allocation.achieved.torque_B - demand.torque_B);
    out(kVelocityIntegral) = o.velocity_integral_1_s2.cwiseProduct(velocity_error) + lost_acceleration / o.antiwindup_s;
    out(kRateIntegral) = o.rate_integral_1_s2.cwiseProduct(rate_error) + lost_angular_acceleration / o.antiwindup_s;
    out(kRateFilter) = filtered_acceleration;
    return mixer_.speeds(allocation.thrust);
  }

  std::vector<double> state_for(const Measurement& m, const Setpoint& setpoint, const Command& command) const override {
    const CascadeOptions& o = options_;
    Eigen::VectorXd thrust(command.rotor_speed.size());
    for (Eigen::Index j = 0; j < thrust.size(); ++j) thrust[j] = airframe_.rotors[j].thrust(command.rotor_speed[j]);
    const Wrench wrench = mixer_.produced(thrust);
    const Vec3 specific_force = m.R_WB.col(1) * (wrench.thrust / airframe_.mass), &omega = m.omega_WB_B;
    const Vec3 angular_acceleration =
        inverse_inertia_ * (wrench.torque_B - omega.cross(airframe_.inertia_BG_B * omega));
    std::vector<double> state(kStateSize);
    Vec3::Map(&state[kVelocityIntegral]) = specific_force - Vec3::UnitY() * airframe_.gravity -
                                           o.velocity_gain_1_s.cwiseProduct(velocity_error(m, setpoint));
    Vec3::Map(&state[kRateIntegral]) =
        angular_acceleration - o.rate_gain_1_s.cwiseProduct(rate_error(m, setpoint, limited(specific_force)));
    Vec3::Map(&state[kRateFilter]) = omega;
    return state;
  }

 private:
  /// What is missing to the velocity that the position asks for.
  Vec3 velocity_error(const Measurement& m, const Setpoint& setpoint) const {
    Vec3 velocity = options_.position_gain_1_s.cwiseProduct(setpoint.p_W - m.p_WoG_W);
    if (velocity.norm() > options_.max_speed_m_s) velocity *= options_.max_speed_m_s / velocity.norm();
    return velocity + setpoint.v_W - m.v_WG_W;
  }

  /// What is missing to the angular velocity that the attitude asks for.
  Vec3 rate_error(const Measurement& m, const Setpoint& setpoint, const Vec3& specific_force) const {
    const Mat3 R_BD = m.R_WB.transpose() * attitude_for(specific_force, setpoint.yaw);
    const Vec3 limit = options_.max_rate_deg_s * kRadians;
    return options_.attitude_gain_1_s.cwiseProduct(rotation_error(R_BD)).cwiseMax(-limit).cwiseMin(limit) -
           m.omega_WB_B;
  }

  /// Upwards, and within the tilt limit.
  Vec3 limited(Vec3 specific_force) const {
    specific_force.y() = std::max(specific_force.y(), kLeastLift * airframe_.gravity);
    const double across = std::hypot(specific_force.x(), specific_force.z());
    const double largest = specific_force.y() * std::tan(options_.max_tilt_deg * kRadians);
    if (across > largest) {
      specific_force.x() *= largest / across;
      specific_force.z() *= largest / across;
    }
    return specific_force;
  }

  CascadeOptions options_;
  Airframe airframe_;
  Mat3 inverse_inertia_;
  Mixer mixer_;
};

void require_gains(const Vec3& gains, bool positive, const std::string& key) {
  const double least = gains.minCoeff();
  if (!(positive ? least > 0 : least >= 0))
    throw UserError("{}: has {}, must be {} 0", key, least, positive ? ">" : ">=");
}

}  // namespace

std::unique_ptr<Controller> make_cascade(const ControllerOptions& options, const Airframe& airframe,
                                         const std::string& prefix) {
  const CascadeOptions& o = options.cascade;
  const std::string key = prefix + "cascade.";
  require_gains(o.position_gain_1_s, false, key + "position_gain_1_s");
  require_gains(o.velocity_gain_1_s, false, key + "velocity_gain_1_s");
  require_gains(o.velocity_integral_1_s2, false, key + "velocity_integral_1_s2");
  require_gains(o.attitude_gain_1_s, false, key + "attitude_gain_1_s");
  require_gains(o.max_rate_deg_s, true, key + "max_rate_deg_s");
  require_gains(o.rate_gain_1_s, false, key + "rate_gain_1_s");
  require_gains(o.rate_integral_1_s2, false, key + "rate_integral_1_s2");
  require_gains(o.rate_derivative, false, key + "rate_derivative");
  if (options.rate_hz > 0 && options.rate_hz * o.rate_filter_s < 1)
    throw UserError("{}rate_filter_s: is {}, must be at least a sample, {} s", key, o.rate_filter_s,
                    1 / options.rate_hz);
  return std::make_unique<Cascade>(o, airframe, prefix);
}

}  // namespace windhover::control
