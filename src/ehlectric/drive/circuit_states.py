"""States of a circuit that a march has met, each with its modes, and which state follows each change."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ehlectric.drive.circuit_equations import Complex, Integers, Modes, StateSpace, modes_of

# What a film does in a state of the circuit: it insulates, conducts through an arc, or touches.
INSULATES, BURNS, TOUCHES = range(3)

# Columns of the links of a state after what a film may do: the state in which its elements are at their next
# position, and what the film does now.
MOVED, DOES = 3, 4

# States of the circuit for which there is space at first.
_SPACE = 16

# State equations with each film at a place, and what each film does.
SystemIn = Callable[[tuple[int, ...], tuple[int, ...]], StateSpace]

Nodes = tuple[str, str]


class CircuitStates:
    """Modes of all states that a march has met.

    ``rows`` and ``squares`` are the arrays of ``Modes`` of one state after the other. ``links`` of a state
    and a film has the number of the state with this film in another condition, -1 if it is not made yet, and
    what the film does now, shape (states, films, 5).
    """

    def __init__(
        self,
        system_in: SystemIn,
        positions: Sequence[int],
        films: Sequence[Nodes],
        shafts: Sequence[Nodes],
        ring: complex | None = None,
    ) -> None:
        """``positions``, how many each film has; ``films`` and ``shafts``, nodes between which their voltages
        lie; ``ring``, rate at which the source rings [1/s].
        """
        self._system_in, self._positions, self._ring = system_in, tuple(positions), ring
        # Films between the same nodes have one voltage.
        self.voltages = list(dict.fromkeys([*films, *shafts]))
        self.film_voltages = len(dict.fromkeys(films))
        self.row_of_film = [self.voltages.index(nodes) for nodes in films]
        self.row_of_shaft = [self.voltages.index(nodes) for nodes in shafts]
        self._keys: list[tuple[tuple[int, ...], tuple[int, ...]]] = []
        self._numbers: dict[tuple[tuple[int, ...], tuple[int, ...]], int] = {}
        first = (0,) * len(films), (INSULATES,) * len(films)
        modes = self._modes(first)
        self.rows: Complex = np.zeros((_SPACE, *modes.rows.shape), dtype=complex)
        self.squares: Complex = np.zeros((_SPACE, *modes.squares.shape), dtype=complex)
        self.links: Integers = np.full((_SPACE, len(films), DOES + 1), -1)
        self._add(first, modes)

    @property
    def size(self) -> int:
        """Number of states of the circuit: potentials and currents."""
        return int(self.squares.shape[2])

    def make(self, state: int, film: int, change: int) -> None:
        """Make the state that follows a change of a film, and link it; arrays may be replaced by larger ones.

        ``change``, what the film does from now on, or ``MOVED``.
        """
        places, doing = self._keys[state]
        if change == MOVED:
            places = _with(places, film, (places[film] + 1) % self._positions[film])
        else:
            doing = _with(doing, film, change)
        key = places, doing
        if key not in self._numbers:
            self._add(key, self._modes(key))
        self.links[state, film, change] = self._numbers[key]

    def _modes(self, key: tuple[tuple[int, ...], tuple[int, ...]]) -> Modes:
        return modes_of(self._system_in(*key), self.voltages, self._ring)

    def _add(self, key: tuple[tuple[int, ...], tuple[int, ...]], modes: Modes) -> None:
        number = len(self._keys)
        if number == self.links.shape[0]:
            self.rows = np.concatenate([self.rows, np.zeros_like(self.rows)])
            self.squares = np.concatenate([self.squares, np.zeros_like(self.squares)])
            self.links = np.concatenate([self.links, np.full_like(self.links, -1)])
        self.rows[number], self.squares[number] = modes
        self.links[number, :, DOES] = key[1]
        self._keys.append(key)
        self._numbers[key] = number


def _with(values: tuple[int, ...], place: int, value: int) -> tuple[int, ...]:
    """Copy of some numbers with another one at a place."""
    return (*values[:place], value, *values[place + 1 :])
