"""``python -m skillwrapper``: the command line."""

from skillwrapper.cli.main import main

main()
