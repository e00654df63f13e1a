"""Exact solutions of the Euler and acoustic equations."""
