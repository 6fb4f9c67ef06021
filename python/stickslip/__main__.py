"""``python -m stickslip`` is the command ``stickslip``."""

import sys

from .cli import main

sys.exit(main())
