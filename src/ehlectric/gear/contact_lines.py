"""Lines of contact of a gear pair in its plane of action. SI units.

In the plane of action, with x along the path of contact from A and y along the face, the lines of contact are

    x = (tau + k) p_bt + y tan beta_b        for all whole k, inside 0 <= x <= g_alpha and 0 <= y <= b.

tau is the phase of the mesh, which grows by 1 while one tooth passes. The area of the plane over the distance
of two lines gives the mean length over a phase, eps_alpha b/cos beta_b. With the fractional parts n_a of
eps_alpha and n_b of eps_beta, the least and the greatest length, divided by the mean length, are

    1 - n_a n_b/(eps_alpha eps_beta)                      if n_a + n_b <= 1
    1 - (1 - n_a)(1 - n_b)/(eps_alpha eps_beta)           otherwise
    1 + min(n_a, n_b) (1 - max(n_a, n_b))/(eps_alpha eps_beta)

A spur pair has the limit of these for eps_beta to 0: floor(eps_alpha) and ceil(eps_alpha) lines of length b.
"""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array
from ehlectric.dataclass import dataclass
from ehlectric.gear.contact_path import ContactPath


@dataclass(frozen=True)
class PlaneOfAction:
    """Plane of action, a rectangle: path of contact times common face width."""

    path: ContactPath
    face_width: float  # b [m]

    @property
    def overlap_ratio(self) -> float:
        """Overlap ratio eps_beta, dimensionless."""
        return self.face_width * math.tan(self.path.base_helix_angle) / self.path.base_pitch

    @property
    def mean_length(self) -> float:
        """Mean length of all lines of contact over a phase [m]."""
        return self.path.contact_ratio * self.face_width / math.cos(self.path.base_helix_angle)

    @property
    def extreme_lengths(self) -> tuple[float, float]:
        """Least and greatest length of all lines of contact [m]."""
        alpha, beta = self.path.contact_ratio, self.overlap_ratio
        part_a = alpha - math.floor(alpha)
        if beta == 0.0:
            return math.floor(alpha) * self.face_width, math.ceil(alpha) * self.face_width
        part_b = beta - math.floor(beta)
        least = part_a * part_b if part_a + part_b <= 1.0 else (1.0 - part_a) * (1.0 - part_b)
        most = min(part_a, part_b) * (1.0 - max(part_a, part_b))
        mean = self.mean_length
        return mean * (1.0 - least / (alpha * beta)), mean * (1.0 + most / (alpha * beta))

    def places(self, phase: Array, across: Array) -> Array:
        """Places g on the path of contact at which lines meet slices of the face.

        ``phase``, phases tau, shape (p,); ``across``, places y of the slices on the face [m], shape (s,).
        Returns g [m], shape (p, k, s), of all k lines that enter the plane; NaN where a line is outside.
        """
        path, pitch = self.path, self.path.base_pitch
        shift = across * math.tan(path.base_helix_angle)
        numbers = np.arange(-math.ceil(self.overlap_ratio) - 1, math.ceil(path.contact_ratio) + 1)
        x = (phase[:, None, None] + numbers[:, None]) * pitch + shift
        # A place on the edge belongs to one line only, so that no pair is counted twice in a spur gear.
        return np.where((x >= 0.0) & (x < path.length), path.start + x, np.nan)

    def length(self, phase: float) -> float:
        """Length of all lines of contact at a phase [m], exactly.

        Examples
        --------
        One and two pairs of a spur gear with a contact ratio of 1.5 and a face of 10 mm:

        >>> path = ContactPath(1e-3, 4e-3, 7e-3, 4e-3, 20e-3, 0.0)
        >>> [round(1e3 * PlaneOfAction(path, 10e-3).length(phase), 6) for phase in (0.25, 0.75)]
        [20.0, 10.0]
        """
        path, tangent = self.path, math.tan(self.path.base_helix_angle)
        total = 0.0
        for number in range(-math.ceil(self.overlap_ratio) - 1, math.ceil(path.contact_ratio) + 1):
            x = (phase + number) * path.base_pitch
            if tangent == 0.0:
                total += self.face_width if 0.0 <= x < path.length else 0.0
            else:
                begin, end = max(0.0, -x / tangent), min(self.face_width, (path.length - x) / tangent)
                total += max(0.0, end - begin)
        return total / math.cos(path.base_helix_angle)
