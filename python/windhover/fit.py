"""Numbers drawn from several values: orders of convergence, harmonics."""

import numpy as np


def order(sizes, errors):
    """Slope of log error over log size, by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def harmonic(time, values, omega):
    """Complex amplitude z of the part of the values that is Re(z exp(iωt)); a constant part is left aside."""
    basis = np.column_stack([np.cos(omega * time), -np.sin(omega * time), np.ones_like(time)])
    (real, imaginary, _), *_ = np.linalg.lstsq(basis, values, rcond=None)
    return complex(real, imaginary)


def l2(volume, error):
    """Mean square over the volume, as a root."""
    return float(np.sqrt((volume * error**2).sum() / volume.sum()))
