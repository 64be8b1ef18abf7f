"""Recipe for Spack: in the top folder of mpm_par
    spack repo add packaging/spack
    spack dev-build mpm-par@0.1.0
"""
from spack.package import *


class MpmPar(CMakePackage):
    """Crushes micrographs of wood with the material point method, on a laptop or on a cluster."""

    license("MIT")
    version("0.1.0")

    variant("vector", default="native", values=("native", "baseline", "avx2", "avx512"),
            multi=False, description="Processors that it is built for")
    variant("study", default=True, description="What mpm_study imports")
    variant("report", default=True, description="What mpm_report imports")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("petsc@3.15: +mpi")
    depends_on("hdf5@1.10: +mpi")
    depends_on("metis@5:")
    depends_on("eigen@3.3:")
    depends_on("yaml-cpp@0.7:")
    depends_on("cli11@2.1:")
    depends_on("fmt@9:")
    depends_on("spdlog@1.10:")
    depends_on("udunits@2.2:")
    depends_on("muparser@2.3:")
    depends_on("libtiff@4:")
    depends_on("stb")
    depends_on("zlib-api")
    depends_on("pugixml@1.12:")
    depends_on("nlohmann-json@3.11:")
    depends_on("python@3.9:", type=("build", "run"))
    for option in "+study", "+report":
        with when(option):
            depends_on("py-pyyaml", type=("build", "run"))
            depends_on("py-numpy", type=("build", "run"))
            depends_on("py-matplotlib", type=("build", "run"))
            depends_on("py-pillow", type=("build", "run"))
    with when("+report"):
        depends_on("py-h5py +mpi", type=("build", "run"))  # with the HDF5 of the program

    conflicts("%gcc@:11", msg="mpm_par is C++20: GCC 12 is the first that builds it")

    def cmake_args(self):
        return [
            self.define_from_variant("MPM_VECTOR", "vector"),
            self.define("MPM_BUILD_TESTS", False),
            self.define("MPM_STUDY_PYTHON", self.python_for("+study")),
            self.define("MPM_REPORT_PYTHON", self.python_for("+report")),
        ]

    def python_for(self, option):
        """The Python that has what this option brings; nothing without it."""
        return self.spec["python"].command.path if self.spec.satisfies(option) else ""
