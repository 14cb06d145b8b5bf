// The module kerf._mpi: a communicator of MPI as the ranks that kerf._kerf knows, which itself needs no MPI. The kernel
// is in that module alone.
#include <cstdint>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>

#include "base/mpi/host_processors.h"

namespace py = pybind11;

namespace {

std::string library_version() {
    std::string text(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    text.resize(length);
    return text;
}

// Calls work(ranks, processors of this one) while there are ranks of the communicator at an address. An exception on
// one rank alone ends the others, which may wait for it.
py::object with_ranks(std::uintptr_t address, const py::function& work) {
    std::optional<kerf::MpiRanks> ranks;
    const auto processors = [&] {
        const py::gil_scoped_release released;
        ranks.emplace(*reinterpret_cast<MPI_Comm*>(address));
        return run_together(*ranks, [&] { return host_processors(*ranks).share(); });
    }();
    try {
        return work(py::cast(&*ranks, py::return_value_policy::reference), processors);
    } catch (const py::error_already_set& error) {
        const kerf::StageStatus why{static_cast<int>(kerf::ErrorCode::internal), error.what()};
        const py::gil_scoped_release released;
        ranks->leave(why);
        throw;
    }
}

}  // namespace

PYBIND11_MODULE(_mpi, module) {
    py::module_::import("kerf._kerf");  // registers kerf::Communicator and the errors of Python
    py::class_<kerf::MpiRanks, kerf::Communicator>(module, "Ranks");
    module.def("library_version", &library_version);
    module.def("with_ranks", &with_ranks, py::arg("address"), py::arg("work"));
}
