"""Values of the asperities of a bearing for summary.json and the table of contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.bearing.intermittency.duty import BearingDuty, RingDuty
from ehlectric.bearing.solution import BearingSolution


def duty_summary(solution: BearingSolution, duty: BearingDuty) -> dict[str, Any]:
    """Regime, shares of time and load shares of a bearing, as in the table ``bearing`` of summary.json."""
    rq = solution.case.bearing.composite_rq
    found: dict[str, Any] = {
        "regime": duty.regime,
        "contact_time_share": duty.contact_time_share,
        "insulating_time_share": 1.0 - duty.touching_time_share,
        "touching_time_share": duty.touching_time_share,
        "clarke_time_share": duty.clarke_time_share,
        "contact_model": duty.model,
    }
    for k, name in enumerate(("inner", "outer")):
        rings = [position.rings[k] for position in solution.positions]
        least = [np.min(ring.values.minimum_thickness[ring.solved], initial=np.inf) for ring in rings]
        found[f"{name}_lambda_ratio"] = float(min(least)) / rq
    for k, name in enumerate(("inner", "outer")):
        shares = [rings[k].contact_time_share for rings in duty.rings]
        found[f"{name}_contact_time_share"] = float(np.max(shares))
    all_of = [ring for rings in duty.rings for ring in rings]
    for key in ("asperity_share", "asperity_share_low", "asperity_share_high"):
        found[key] = float(max(np.max(getattr(ring, key)) for ring in all_of))
    spots = [np.max(ring.expected_spots) for ring in all_of if ring.expected_spots is not None]
    return found | {"expected_spots": float(max(spots)) if spots else None}


def contact_duty(ring: RingDuty, k: int) -> dict[str, float | None]:
    """Values of the contact of element ``k`` with a ring, as in a row of ``contacts``."""
    ratio, spots = ring.central_lambda_ratio[k], ring.expected_spots
    return {
        "central_lambda_ratio": float(ratio) if np.isfinite(ratio) else None,
        "asperity_share": float(ring.asperity_share[k]),
        "asperity_share_low": float(ring.asperity_share_low[k]),
        "asperity_share_high": float(ring.asperity_share_high[k]),
        "contact_probability": float(ring.contact_probability[k]),
        "expected_spots": None if spots is None else float(spots[k]),
        "contact_time_share": float(ring.contact_time_share[k]),
    }
