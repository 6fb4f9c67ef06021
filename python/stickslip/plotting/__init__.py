"""Pictures in a common style; needs matplotlib (``pip install stickslip[plot]``).

Pictures of one panel are drawn into ``ax=``, pictures of several into ``figure=``, a Figure or
SubFigure, and return what they were given: so they fit into a figure that `plt.subplots` made.
Without either they make a new matplotlib Figure and return it: a notebook shows it, `save` or its
own `savefig` writes it. If pyplot was imported and has windows, plt.show() shows it too; otherwise
pyplot is not touched. The colors are those of Okabe and Ito, which color-blind readers can
distinguish, also in grayscale print.
"""

from __future__ import annotations

try:
    import matplotlib as _matplotlib  # noqa: F401
except ImportError as error:
    raise ImportError(
        "stickslip.plotting: plots need matplotlib, which is missing; pip install stickslip[plot]"
    ) from error

from .animation import Animation, animate
from .animation import check_moving_suffix as check_moving_suffix
from .carts import plot_cart_response
from .comparison import plot_comparison
from .directions import plot_orientations
from .ensemble import plot_ensemble
from .figures import check_suffix as check_suffix
from .figures import new_figure as new_figure
from .figures import save
from .fragility import plot_design_chart, plot_exceedances, plot_fragility
from .ground import plot_ground_motion, plot_response_spectrum
from .hysteresis import plot_hysteresis
from .pendulum import plot_pendulum_loop, plot_surfaces
from .planar import plot_planar_response
from .response import plot_response, plot_responses
from .rocking import plot_overturning, plot_rocking_phase, plot_rocking_response
from .structure import plot_floors, plot_modes, plot_structure_response
from .styles import BLUE as BLUE
from .styles import COLORS as COLORS
from .styles import GRAY as GRAY
from .styles import INK as INK
from .styles import PALE as PALE
from .styles import VERMILION as VERMILION
from .styles import style
from .sweep import plot_friction_sweep, plot_sweep
from .trajectory import sticks, without_contact

# Names with `as` are those that the package's own pictures use, too.
__all__ = [
    "Animation",
    "animate",
    "plot_cart_response",
    "plot_comparison",
    "plot_design_chart",
    "plot_ensemble",
    "plot_exceedances",
    "plot_floors",
    "plot_fragility",
    "plot_friction_sweep",
    "plot_ground_motion",
    "plot_hysteresis",
    "plot_modes",
    "plot_orientations",
    "plot_overturning",
    "plot_pendulum_loop",
    "plot_planar_response",
    "plot_response",
    "plot_response_spectrum",
    "plot_responses",
    "plot_rocking_phase",
    "plot_rocking_response",
    "plot_structure_response",
    "plot_surfaces",
    "plot_sweep",
    "save",
    "sticks",
    "style",
    "without_contact",
]
