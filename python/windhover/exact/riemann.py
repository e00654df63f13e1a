"""The Riemann problem of a perfect gas; states are (density, velocity, pressure)."""

import numpy as np


def _wave(p, side, gamma):
    """Velocity jump over the wave between a side and pressure p, and its derivative."""
    density, _, pressure = side
    if p > pressure:
        a, b = 2 / ((gamma + 1) * density), (gamma - 1) / (gamma + 1) * pressure
        root = np.sqrt(a / (p + b))
        return (p - pressure) * root, root * (1 - (p - pressure) / (2 * (p + b)))
    sound = np.sqrt(gamma * pressure / density)
    power = (gamma - 1) / (2 * gamma)
    jump = 2 * sound / (gamma - 1) * ((p / pressure) ** power - 1)
    return jump, (p / pressure) ** (-(gamma + 1) / (2 * gamma)) / (density * sound)


def _behind(p, side, gamma):
    """Density between a side's wave and the contact."""
    density, _, pressure = side
    ratio, k = p / pressure, (gamma - 1) / (gamma + 1)
    return density * ((ratio + k) / (k * ratio + 1) if ratio > 1 else ratio ** (1 / gamma))


def star(left, right, gamma=1.4):
    """Pressure and velocity between the outer waves."""
    p = 0.5 * (left[2] + right[2])
    for _ in range(100):
        (jump_left, rate_left), (jump_right, rate_right) = _wave(p, left, gamma), _wave(p, right, gamma)
        step = (jump_left + jump_right + right[1] - left[1]) / (rate_left + rate_right)
        p = max(p - step, 0.01 * p)
        if abs(step) < 1e-14 * p:
            break
    velocity = 0.5 * (left[1] + right[1] + _wave(p, right, gamma)[0] - _wave(p, left, gamma)[0])
    return p, velocity


def speeds(left, right, gamma=1.4):
    """Speeds of the left wave's two edges, of the contact and of the right wave's two edges; equal edges are a shock."""
    p, u = star(left, right, gamma)

    def edges(side, sign):
        density, velocity, pressure = side
        sound = np.sqrt(gamma * pressure / density)
        if p > pressure:
            shock = velocity + sign * sound * np.sqrt(1 + (gamma + 1) / (2 * gamma) * (p / pressure - 1))
            return shock, shock
        return velocity + sign * sound, u + sign * np.sqrt(gamma * p / _behind(p, side, gamma))

    return *edges(left, -1), u, *reversed(edges(right, 1))


def solution(xi, left, right, gamma=1.4):
    """Density, velocity and pressure at x/t = xi."""
    p, u = star(left, right, gamma)
    head_left, tail_left, contact, tail_right, head_right = speeds(left, right, gamma)

    def fan(side, sign):
        density, velocity, pressure = side
        sound = np.sqrt(gamma * pressure / density)
        ratio = 2 / (gamma + 1) - sign * (gamma - 1) / (gamma + 1) * (velocity - xi) / sound
        ratio = np.maximum(ratio, 0)
        speed = 2 / (gamma + 1) * (-sign * sound + 0.5 * (gamma - 1) * velocity + xi)
        return density * ratio ** (2 / (gamma - 1)), speed, pressure * ratio ** (2 * gamma / (gamma - 1))

    regions = [xi < head_left, xi < tail_left, xi < contact, xi < tail_right, xi < head_right]
    between_left = _behind(p, left, gamma), u, p
    between_right = _behind(p, right, gamma), u, p
    values = [left, fan(left, -1), between_left, between_right, fan(right, 1)]
    return tuple(np.select(regions, [value[i] for value in values], right[i]) for i in range(3))
