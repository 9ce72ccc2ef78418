"""make_conan_package.py RECIPE PACKAGE VERSION: goes through the steps of `conan create` with a recipe of a header library."""
import fnmatch
import importlib.util
import os
import shutil
import sys
import tempfile

recipe_folder, package_folder, version = sys.argv[1:]
spec = importlib.util.spec_from_file_location("conanfile", os.path.join(recipe_folder, "conanfile.py"))
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
recipe = module.Taut()
assert (recipe.name, recipe.version, recipe.license) == ("taut", version, "MIT")
assert recipe.package_type == "header-library"


class Settings:
    def __init__(self, values):
        self.values = values

    def get_safe(self, name):
        return self.values.get(name)


class Info:
    cleared = False

    def clear(self):
        self.cleared = True


class CppInfo:
    def __init__(self):
        self.properties, self.cxxflags = {}, []

    def set_property(self, name, value):
        self.properties[name] = value


required = []
recipe.requires = lambda name, **traits: required.append((name, traits))
recipe.requirements()
assert required == [("eigen/3.4.0", {"transitive_headers": True})]

recipe.settings = Settings({"compiler": "gcc", "compiler.cppstd": "17"})
recipe.validate()
recipe.settings.values["compiler.cppstd"] = "14"
try:
    recipe.validate()
    raise AssertionError("C++14 is not refused")
except ValueError:
    pass
recipe.info = Info()
recipe.package_id()
assert recipe.info.cleared, "a package of headers is one for all settings"

# Only what is exported is there when the package is made.
with tempfile.TemporaryDirectory() as source:
    for folder, _, files in os.walk(recipe_folder):
        for name in files:
            path = os.path.relpath(os.path.join(folder, name), recipe_folder)
            if any(fnmatch.fnmatch(path, pattern) for pattern in recipe.exports_sources):
                os.makedirs(os.path.dirname(os.path.join(source, path)), exist_ok=True)
                shutil.copy(os.path.join(recipe_folder, path), os.path.join(source, path))
    recipe.source_folder, recipe.package_folder = source, package_folder
    recipe.package()

for compiler, contracts in (("gcc", False), ("clang", False), ("msvc", True)):
    recipe.settings, recipe.cpp_info = Settings({"compiler": compiler}), CppInfo()
    recipe.package_info()
    assert recipe.cpp_info.properties["cmake_target_name"] == "taut::taut"
    assert ("-ffp-contract=off" not in recipe.cpp_info.cxxflags) == contracts
