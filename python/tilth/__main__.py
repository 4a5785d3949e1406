"""``python -m tilth`` is the program ``tilth``."""

from tilth.program import main

if __name__ == "__main__":
    main()
