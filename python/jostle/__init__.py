"""Seismic pounding of neighbouring buildings by the transfer matrix method.

Quantities are texts with units (``"20 mm"``, ``"0.35 g"``), bare numbers in SI, or keywords with the unit in their
name (``width_mm=20``). Arrays and results are in SI. Displacements are relative to the ground and positive to the
right; forces of contacts are positive in compression.

Examples:
    >>> import jostle
    >>> result = jostle.run(jostle.Model.paper_example())
    >>> print(result)
"""

from ._animation import Animation
from ._answers import Answers
from ._builders import Frame, Gap, Given, Link, Shear, Soil, SpaceFrame, Wall
from ._check import Check
from ._city import (
    City,
    CityResult,
    CitySummary,
    ClassesResult,
    Footprints,
    city_types,
    classes,
    example_city,
    footprints,
)
from ._collide import Collision, ContactLaw, collide, collide_all, contact_laws
from ._compare import Comparison, compare
from ._contact_advice import ContactAdvice, LateralRule, StiffnessEstimate, StiffnessRange, WaveEstimate, contact_advice
from ._errors import (
    AnalysisError,
    Fault,
    InterruptedWarning,
    JostleError,
    JostleWarning,
    MissingFileError,
    ModelError,
    ModelWarning,
    StudyWarning,
)
from ._export import Script
from ._gradients import Gradient, gradients
from ._import import Imported, import_etabs, import_sap2000
from ._jostle import __version__
from ._matrices import Matrices
from ._method import MethodSurvey, method, schema, template
from ._model import Model
from ._modes import BuildingModes, modes
from ._motion import Motion, Spectrum
from ._opensees import from_opensees, import_opensees
from ._own_law import Experiment, experiment
from ._pushover import CapacityCurve, pushover
from ._result import BuildingResult, Contact, Corner, Floor, LinkedFloors, Result
from ._run import run
from ._section import SectionAnswer, section
from ._selection import DesignSpectrum, Selection
from ._size import SizeAnswer, size
from ._study import (
    AngleStudy,
    CriticalGap,
    GapPoint,
    RuleGap,
    Study,
    StudyResult,
    WorstAngle,
    angles,
    critical_gap,
)
from ._suite import Governing, Suite, run_suite
from ._table import Table

__all__ = [
    "AnalysisError",
    "AngleStudy",
    "Animation",
    "Answers",
    "BuildingModes",
    "BuildingResult",
    "CapacityCurve",
    "Check",
    "City",
    "CityResult",
    "CitySummary",
    "ClassesResult",
    "Collision",
    "Comparison",
    "Contact",
    "ContactAdvice",
    "ContactLaw",
    "Corner",
    "CriticalGap",
    "DesignSpectrum",
    "Experiment",
    "Fault",
    "Floor",
    "Footprints",
    "Frame",
    "Gap",
    "GapPoint",
    "Given",
    "Governing",
    "Gradient",
    "Imported",
    "InterruptedWarning",
    "JostleError",
    "JostleWarning",
    "LateralRule",
    "Link",
    "LinkedFloors",
    "Matrices",
    "MethodSurvey",
    "MissingFileError",
    "Model",
    "ModelError",
    "ModelWarning",
    "Motion",
    "Result",
    "RuleGap",
    "Script",
    "SectionAnswer",
    "Selection",
    "Shear",
    "SizeAnswer",
    "Soil",
    "SpaceFrame",
    "Spectrum",
    "StiffnessEstimate",
    "StiffnessRange",
    "Study",
    "StudyResult",
    "StudyWarning",
    "Suite",
    "Table",
    "Wall",
    "WaveEstimate",
    "WorstAngle",
    "__version__",
    "angles",
    "city_types",
    "classes",
    "collide",
    "collide_all",
    "compare",
    "contact_advice",
    "contact_laws",
    "critical_gap",
    "example_city",
    "experiment",
    "footprints",
    "from_opensees",
    "gradients",
    "import_etabs",
    "import_opensees",
    "import_sap2000",
    "method",
    "modes",
    "pushover",
    "run",
    "run_suite",
    "schema",
    "section",
    "size",
    "template",
]
