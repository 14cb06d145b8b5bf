// A cube in seven parts, on the ranks of a test program that runs under mpirun.
#pragma once

#include <mpi.h>

#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "cli/ranks.h"
#include "files/part/run_parts.h"
#include "solve/space/fe_space.h"
#include "support/assets.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf::test {

inline int rank() {
    int number = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &number);
    return number;
}
inline int ranks() {
    int number = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &number);
    return number;
}

inline const Ranks* ranks_of_program = nullptr;  // those of this program

// Meshes of a cube in seven parts, made by the first rank for all: with edges of 0.2 and, if they can, 0.5; and with
// its surface remeshed edges of 0.4 and 0.2.
class CubeOfParts : public testing::Environment {
 public:
    void SetUp() override {
        std::array<char, 4096> path{};
        if (rank() == 0) {
            folder_ = std::make_unique<TemporaryFolder>();
            mesh("fine", "0.2", "keep");
            mesh("coarse", "0.5", "remesh");
            mesh("sized0", "0.2", "remesh");
            mesh("sized1", "0.1", "remesh");
            folder_->file("").copy(path.data(), path.size() - 1);
        }
        MPI_Bcast(path.data(), static_cast<int>(path.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
        parts = std::make_unique<RunParts>(std::string(path.data()) + "fine");
        coarse_parts = std::make_unique<RunParts>(std::string(path.data()) + "coarse");
        for (std::size_t i = 0; i < sized_parts.size(); ++i)
            sized_parts[i] = std::make_unique<RunParts>(std::string(path.data()) + "sized" + std::to_string(i));
    }
    void TearDown() override {
        MPI_Barrier(MPI_COMM_WORLD);
        folder_.reset();
    }
    inline static std::unique_ptr<RunParts> parts, coarse_parts;
    inline static std::array<std::unique_ptr<RunParts>, 2> sized_parts;

 private:
    void mesh(const std::string& name, const char* size, const char* surface) const {
        // It is no rank of this job.
        const ChildResult result = run_program("/usr/bin/env", {"-u",
                                                                "OMPI_COMM_WORLD_SIZE",
                                                                "-u",
                                                                "OMPI_COMM_WORLD_RANK",
                                                                "-u",
                                                                "PMIX_RANK",
                                                                "-u",
                                                                "PMI_RANK",
                                                                test::kerf_program(),
                                                                "mesh",
                                                                asset_path("cube"),
                                                                "-o",
                                                                folder_->file(name),
                                                                "-n",
                                                                "7",
                                                                "--size",
                                                                size,
                                                                "--surface",
                                                                surface,
                                                                "-q"});
        EXPECT_EQ(result.exit_code, 0) << result.log;
    }
    std::unique_ptr<TemporaryFolder> folder_;
};

// The parts of a communicator's rank.
inline std::vector<Part> parts_on(const MpiRanks& of_space, const RunParts& mesh) {
    const int own = of_space.rank();
    const std::vector<PartIndex> first = first_parts_of_ranks(mesh.outline(), of_space.size());
    std::vector<Part> parts;
    for (const PartIndex index : IdRange(first[own], first[own + 1])) parts.push_back(mesh.load(index));
    return parts;
}

// The space of these parts of a communicator's rank.
inline std::unique_ptr<FeSpace> space_of(MpiRanks& of_space, const RunParts& mesh, std::vector<Part> parts, int order) {
    const MeshOutline& outline = mesh.outline();
    return std::make_unique<FeSpace>(of_space, outline, first_parts_of_ranks(outline, of_space.size()),
                                     std::move(parts), order);
}
inline std::unique_ptr<FeSpace> space_on(MpiRanks& of_space, int order, RunParts& mesh = *CubeOfParts::parts) {
    return space_of(of_space, mesh, parts_on(of_space, mesh), order);
}

inline double largest(double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return value;
}

}  // namespace kerf::test
