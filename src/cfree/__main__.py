"""``python -m cfree``."""

from cfree.cli.app import main

if __name__ == "__main__":
    main()
