"""The command ``ppum`` as ``python -m ppum``."""

import sys

from ._command import main

sys.exit(main())
