"""Published reductions of a film by the heat of shear in its inlet, over the thermal loading parameter.

L = eta0 beta u^2/k with the mean speed u of both surfaces; the factors are the film over the isothermal one.
"""


def wilson_sheu(loading, slide_to_roll_ratio=0.0):
    """Wilson and Sheu, J. Lubr. Technol. 105 (1983) 187: 1/(1 + 0.241 (1 + 14.8 Z^0.83) L^0.64), eq. (7).

    Z = (u1 - u2)/(u1 + u2), eq. (5), is half of the slide-to-roll ratio (u1 - u2)/u.
    """
    slip = 1.0 + 14.8 * (slide_to_roll_ratio / 2.0) ** 0.83
    return 1.0 / (1.0 + 0.241 * slip * loading**0.64)


def murch_wilson(loading):
    """Murch and Wilson, J. Lubr. Technol. 97 (1975) 212, in pure rolling: 3.94/(3.94 + L^0.62).

    Wilson and Sheu print it as 1/(1 + 0.254 L^0.62), eq. (9).
    """
    return 3.94 / (3.94 + loading**0.62)


def gupta(loading, pressure_ratio, slide_to_roll_ratio=0.0):
    """Gupta, Cheng, Zhu, Forster and Schrand, Tribol. Trans. 35 (1992) 269, with p_h/E'; second-hand.

    (1 - 13.2 (p_h/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64)
    """
    slip = 1.0 + 2.23 * slide_to_roll_ratio**0.83
    return (1.0 - 13.2 * pressure_ratio * loading**0.42) / (1.0 + 0.213 * slip * loading**0.64)
