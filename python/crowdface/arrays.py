# SPDX-License-Identifier: Apache-2.0
"""Types of arrays."""

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]
Indices = npt.NDArray[np.uint32]
Positions = Numbers
"""Vertex positions, (V, 3)."""
