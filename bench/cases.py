"""What is compared: models, and how OpenSees is run on them."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Case:
    """One model and one motion."""

    name: str
    title: str
    model: str  # a built-in name, or a file in bench/models
    options: tuple[str, ...] = ()  # of jostle run and jostle export
    linear: bool = True  # whether nothing but contact is non-linear
    solvers: tuple[str, ...] = ("riccati", "modal")  # of jostle, if they can
    quick: bool = False
    by_name: bool = False  # only if asked for: OpenSees takes a quarter of an hour for one run
    free_steps: tuple[float, ...] = (4e-3, 2e-3, 1e-3)  # tried for OpenSees, in free vibration [s]
    parts: tuple[int, ...] = (5, 10, 20)  # of them around contact
    piece: float = 1.0  # of the motion, from which the time of uniform steps is estimated [s]
    extra: dict = field(default_factory=dict)


CASES = [
    Case("few", "J1 and J2, 220 cm/s², 100 mm: one impact", "paper", ("--pga", "220cm/s2", "--gap", "100mm")),
    Case("many", "J1 and J2, 70 cm/s², 10 mm: 21 impacts", "paper", ("--pga", "70cm/s2", "--gap", "10mm")),
    Case("inelastic", "J1 and J2 yielding, 400 cm/s², 100 mm, 15 s", "inelastic.toml", linear=False, free_steps=(2e-3, 1e-3), parts=(5, 10)),
    Case("yielding-towers", "four beside six storeys that yield, 0.3 g, 31 s", "yielding-towers.toml", linear=False, solvers=("riccati", "series"), free_steps=(2e-3, 1e-3), parts=(5, 10)),
    Case("towers", "two towers, one mass each", "two-towers.toml", quick=True),
    Case("high-rise", "twenty beside forty storeys", "high-rise.toml", free_steps=(4e-3, 2e-3), parts=(5, 10)),
    Case("row", "ten frames in a row, 15 s", "row-of-ten.toml", free_steps=(4e-3, 2e-3), parts=(5, 10)),
    Case("linked-row", "ten frames in a row with dampers between them, 15 s", "linked-row-of-ten.toml", free_steps=(4e-3, 2e-3), parts=(5, 10)),
    Case("space", "two towers of ten storeys in space, 31 s", "two-towers-in-space.toml", solvers=("modal",), free_steps=(4e-3, 2e-3, 1e-3), parts=(5, 10)),
    Case("space-block", "block of nine buildings in space, 31 s", "block-of-nine.toml", solvers=("modal",), by_name=True, free_steps=(4e-3, 2e-3), parts=(5, 10)),
    Case("piece", "J1 and J2, 70 cm/s², 10 mm, the first 5 s", "piece.toml", quick=True),
]
