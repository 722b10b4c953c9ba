"""An oracle for linear filters: the joint Gaussian of all states and measurements, conditioned."""

import numpy as np
from scipy.linalg import block_diag


class JointGaussian:
    """All x and z of x' = F_k x + b_k + w, z = H x + v, as one linear map of the noises."""

    def __init__(self, F, b, H, Q, R, mean, covariance):
        n, K, m = len(mean), len(F), len(H)
        source = block_diag(covariance, *[Q] * K, *[R] * (K + 1))
        size = source.shape[0]
        row, offset = np.eye(n, size), np.asarray(mean, dtype=float)
        rows, offsets = [row], [offset]
        for k in range(K):
            row, offset = F[k] @ row, F[k] @ offset + b[k]
            row[:, n * (k + 1) : n * (k + 2)] += np.eye(n)
            rows.append(row)
            offsets.append(offset)
        noise = np.eye(size)[n * (K + 1) :].reshape(K + 1, m, size)
        self.X = np.array(rows)
        self.x_mean = np.array(offsets)
        self.Z = np.array([H @ row + v for row, v in zip(rows, noise, strict=True)])
        self.z_mean = np.array([H @ x for x in offsets])
        self.source = source

    def state(self, k, z):
        """Mean and covariance of x_k, given the first len(z) measurements, z of shape (j, m)."""
        X, Z = self.X[k], np.vstack(self.Z[: len(z)])
        gain = np.linalg.solve(Z @ self.source @ Z.T, Z @ self.source @ X.T).T
        deviation = np.ravel(z) - np.ravel(self.z_mean[: len(z)])
        covariance = X @ self.source @ X.T - gain @ Z @ self.source @ X.T
        return self.x_mean[k] + gain @ deviation, covariance

    def log_density(self, z):
        """Logarithm of the density of all measurements at z."""
        Z = np.vstack(self.Z)
        covariance, deviation = Z @ self.source @ Z.T, np.ravel(z) - np.ravel(self.z_mean)
        _, logdet = np.linalg.slogdet(2 * np.pi * covariance)
        return -0.5 * (logdet + deviation @ np.linalg.solve(covariance, deviation))
