"""taut for Conan 2: `conan create .` in this folder."""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy


class Taut(ConanFile):
    name = "taut"
    version = "@VERSION@"
    license = "MIT"
    author = "The taut authors"
    description = "Cable forces with friction in cable-supported structures"
    topics = ("cable", "friction", "post-tensioning", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    exports_sources = "include/*", "LICENSE"
    no_copy_source = True

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)

    def validate(self):
        if self.settings.get_safe("compiler.cppstd"):
            check_min_cppstd(self, 17)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "*.hpp", os.path.join(self.source_folder, "include"), os.path.join(self.package_folder, "include"))
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "taut")
        self.cpp_info.set_property("cmake_target_name", "taut::taut")
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        # The error-free arithmetic rests on a * b + c being rounded twice.
        if str(self.settings.get_safe("compiler")) in ("gcc", "clang", "apple-clang"):
            self.cpp_info.cxxflags = ["-ffp-contract=off", "-fno-math-errno"]
