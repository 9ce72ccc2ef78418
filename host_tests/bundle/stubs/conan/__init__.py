"""What a recipe of a header library sees of Conan."""


class ConanFile:
    pass
