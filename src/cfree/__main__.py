"""``python -m cfree``."""

from cfree.cli import main

if __name__ == "__main__":
    main()
