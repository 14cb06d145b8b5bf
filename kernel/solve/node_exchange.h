// Values at nodes that several ranks hold.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <mpi.h>

namespace kerf {

template <class T>
MPI_Datatype mpi_type();
template <>
inline MPI_Datatype mpi_type<double>() {
    return MPI_DOUBLE;
}
template <>
inline MPI_Datatype mpi_type<std::int32_t>() {
    return MPI_INT32_T;
}
template <>
inline MPI_Datatype mpi_type<std::int64_t>() {
    return MPI_INT64_T;
}

/// Who has which nodes of whom. A node belongs to one rank; ghosts are the copies of other ranks.
class NodeExchange {
 public:
    /// Nodes that a neighbouring rank has, too, in the same order on both sides.
    struct Neighbour {
        int rank = 0;
        std::vector<std::int32_t> nodes;  ///< local numbers
    };

    NodeExchange() = default;
    /// `owned`: nodes of this rank of which others have ghosts; `ghosts`: those of others here. Both ascending by rank.
    NodeExchange(MPI_Comm comm, std::vector<Neighbour> owned, std::vector<Neighbour> ghosts)
        : comm_(comm), owned_(std::move(owned)), ghosts_(std::move(ghosts)) {}

    /// Ghosts become what their owners have. Collective; `values` has a block of so many for each local node.
    template <class T>
    void to_ghosts(std::span<T> values, std::size_t block) const {
        transfer<T>(owned_, ghosts_, values, block, [](T& own, T other) { own = other; });
    }

    /// What ghosts have is added to what their owners have, rank after rank; the ghosts stay as they are. Collective.
    template <class T>
    void add_to_owners(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own += other; });
    }

    /// The smallest value that any rank has for a node becomes that of all of them. Collective.
    template <class T>
    void share_smallest(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own = std::min(own, other); });
        to_ghosts(values, block);
    }

 private:
    template <class T, class Take>
    void transfer(const std::vector<Neighbour>& from, const std::vector<Neighbour>& to, std::span<T> values,
                  std::size_t block, Take take) const {
        std::vector<std::vector<T>> out(from.size()), in(to.size());
        std::vector<MPI_Request> requests;
        for (std::size_t n = 0; n < to.size(); ++n) {
            in[n].resize(to[n].nodes.size() * block);
            MPI_Irecv(in[n].data(), static_cast<int>(in[n].size()), mpi_type<T>(), to[n].rank, 0, comm_,
                      &requests.emplace_back());
        }
        for (std::size_t n = 0; n < from.size(); ++n) {
            out[n].reserve(from[n].nodes.size() * block);
            for (const std::int32_t node : from[n].nodes) {
                const auto values_of_node = values.subspan(static_cast<std::size_t>(node) * block, block);
                out[n].insert(out[n].end(), values_of_node.begin(), values_of_node.end());
            }
            MPI_Isend(out[n].data(), static_cast<int>(out[n].size()), mpi_type<T>(), from[n].rank, 0, comm_,
                      &requests.emplace_back());
        }
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
        for (std::size_t n = 0; n < to.size(); ++n)
            for (std::size_t i = 0; i < to[n].nodes.size(); ++i)
                for (std::size_t c = 0; c < block; ++c)
                    take(values[static_cast<std::size_t>(to[n].nodes[i]) * block + c], in[n][i * block + c]);
    }

    MPI_Comm comm_ = MPI_COMM_SELF;
    std::vector<Neighbour> owned_, ghosts_;
};

}  // namespace kerf
