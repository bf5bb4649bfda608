"""The decorator of dataclasses, compared with the one of the standard library."""

import copy
import dataclasses
import inspect
import pickle
from abc import ABC, abstractmethod
from dataclasses import field
from functools import cached_property

import pytest

from ehlectric.dataclass import dataclass as ours


def classes(dataclass):
    """Classes with all that the package uses, by their names."""

    @dataclass(frozen=True)
    class Empty:
        """No field."""

    @dataclass(frozen=True)
    class Point:
        """Defaults, a factory and a value that is no argument."""

        x: float
        y: float = 2.0
        names: tuple = field(default_factory=tuple)
        hidden: float = field(default=5.0, repr=False, compare=False)
        later: list = field(default_factory=list, init=False, compare=False)

        def __post_init__(self):
            self.later.append(self.x)

        @cached_property
        def double(self):
            return 2 * self.x

    @dataclass(frozen=True)
    class Spot(Point):
        """A base with defaults."""

        y: float = 3.0
        z: float = 4.0

    @dataclass(frozen=True, kw_only=True)
    class Named:
        """Arguments with names."""

        first: int
        second: int = field(default=3, kw_only=False)

    @dataclass(frozen=True, eq=False, repr=False)
    class Plain:
        """Neither text nor comparison."""

        x: float

    @dataclass(frozen=True)
    class Single:
        """A field whose value may be an array."""

        x: object

        def __hash__(self):
            return 7

    class Base(ABC):
        @property
        @abstractmethod
        def size(self): ...

    @dataclass(frozen=True)
    class Sized(Base):
        """A method of an abstract class."""

        x: float

        @property
        def size(self):
            return self.x

    return {each.__name__: each for each in (Empty, Point, Spot, Named, Plain, Single, Sized)}


NAN = float("nan")


def both(use):
    """What a function of the classes returns, or the error that it raises, for both decorators."""

    def result(made):
        try:
            return use(made)
        except Exception as error:
            return type(error), str(error)

    return tuple(result(classes(dataclass)) for dataclass in (ours, dataclasses.dataclass))


@pytest.mark.parametrize("name", classes(ours))
def test_the_signature_is_that_of_the_standard_library(name):
    one, other = both(lambda made: str(inspect.signature(made[name])))
    assert one == other


USES = {
    "text": lambda made: [repr(made["Point"](1.0)), repr(made["Empty"]()), repr(made["Spot"](1.0, z=2.0))],
    "values": lambda made: dataclasses.asdict(made["Spot"](1.0, 2.0, ("a",))),
    "named": lambda made: repr(made["Named"](4, first=1)),
    "without names": lambda made: made["Named"](1, 4),
    "too few": lambda made: made["Point"](),
    "too many": lambda made: made["Empty"](1),
    "equal": lambda made: made["Point"](1.0) == made["Point"](1.0, 2.0, hidden=7.0),
    "other class": lambda made: made["Point"](1.0) == made["Spot"](1.0, 2.0),
    "not a number": lambda made: [made["Single"](NAN) == made["Single"](NAN), made["Single"](NAN) == 3],
    "hashes": lambda made: [hash(made["Point"](1.0)), hash(made["Single"](1.0)), hash(made["Empty"]())],
    "identity": lambda made: made["Plain"](1.0) == made["Plain"](1.0),
    "set": lambda made: setattr(made["Point"](1.0), "x", 3.0),
    "set another": lambda made: setattr(made["Point"](1.0), "other", 3.0),
    "delete": lambda made: delattr(made["Spot"](1.0), "x"),
    "replaced": lambda made: repr(dataclasses.replace(made["Point"](1.0), x=2.0)),
    "replaced, no argument": lambda made: dataclasses.replace(made["Point"](1.0), later=[]),
    "factory": lambda made: made["Point"](1.0).later is made["Point"](1.0).later,
    "default": lambda made: [made["Point"].y, made["Spot"].y, hasattr(made["Point"], "names")],
    "copied": lambda made: copy.deepcopy(made["Point"](1.0)).later,
    "cached": lambda made: made["Point"](1.0).double,
    "abstract": lambda made: made["Sized"](3.0).size,
    "order of patterns": lambda made: made["Spot"].__match_args__,
}


@pytest.mark.parametrize("use", USES)
def test_a_class_behaves_as_with_the_standard_library(use):
    one, other = both(USES[use])
    assert one == other


def test_a_text_that_contains_itself_ends():
    loop = []
    one = classes(ours)["Single"](loop)
    loop.append(one)
    assert repr(one).count("...") == 1


def test_a_class_that_extends_a_frozen_class_of_a_library_is_frozen():
    base = classes(dataclasses.dataclass)["Point"]

    @ours(frozen=True)
    class Extended(base):
        further: float = 1.0

    assert Extended(1.0, further=2.0).further == 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        Extended(1.0).x = 2.0


@ours(frozen=True)
class Sent:
    load: float


def test_an_object_is_sent_to_another_process():
    assert pickle.loads(pickle.dumps(Sent(3.0))) == Sent(3.0)


def test_a_class_without_a_promise_is_not_frozen():
    @ours
    class Free:
        x: float

    free = Free(1.0)
    free.x = 2.0
    assert free == Free(2.0)
