"""To which outlets a wire gets, what it takes, and how that holds where something is off."""

from magwire.planning.outlets import plan as plan
from magwire.planning.perturbations import robustness as robustness
from magwire.planning.prospect import Prospect as Prospect
from magwire.planning.prospect import Trial as Trial
