"""A light sphere that flies off in a gust, with rotors that have no air of their own and a sampled controller; its centre
of gravity lies beside its middle."""

ROTORS = "".join(f"""
[[body.rotor]]
name = "{name}"
inertia_kg_m2 = 1e-4
spin_axis = [0, {spin}, 0]
speed_rad_s = 300
motor = {{ kind = "{motor}" }}
[[controller.rotor]]
name = "{name}"
position_m = [{x}, 0, {z}]
thrust_N_s2 = 4e-5
torque_Nm_s2 = 6e-7
min_speed_rad_s = 50
max_speed_rad_s = 900
""" for name, x, z, spin, motor in (("front_right", 1, 1, 1, "servo"), ("front_left", 1, -1, -1, "servo"),
                                   ("rear_left", -1, -1, 1, "servo"), ("rear_right", -1, 1, -1, "servo")))


def case(meshes):
    return f"""
[mesh]
geometry = "{meshes / 'ball_around_sphere.geo'}"
file = "sphere.msh"
[fluid]
boundary = {{sphere = "wall", far = "farfield"}}
[wind]
velocity_m_s = [-20, 5, 3]
[body]
kind = "dynamic"
mass_kg = 0.2
inertia_kg_m2 = [0.05, 0.06, 0.07]
center_of_gravity_m = [0.02, -0.03, 0.01]
[controller]
kind = "cascade"
rate_hz = 250
plan = [{{time_s = 0}}, {{time_s = 0.0123, position_m = [1, 0, 0]}}]
{ROTORS}
[time]
step_s = 2e-3
steps = 10
[solver]
newton_tolerance = 1e-10
newton_iterations = 30
eisenstat_walker = false
krylov_tolerance = 1e-4
[coupling]
tolerance = 1e-10
pose_tolerance = 1e-10
[output]
checkpoint_interval = 3
"""
