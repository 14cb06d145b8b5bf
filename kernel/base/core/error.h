// The one exception type of the kernel. Its code is the exit code of the program.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kerf {

/// The outcomes of a program. The set is closed; the value is the exit code of every program of Kerf (see
/// docs/output.md).
enum class ErrorCode : int {
    internal = 1,      ///< a bug of Kerf
    usage = 2,         ///< wrong command line or options
    input = 3,         ///< the surface cannot be meshed as it is
    subdomain = 4,     ///< a subdomain could not be meshed; the others are written
    memory = 5,        ///< out of memory or over the budget
    quality = 6,       ///< the quality gate was missed
    io = 7,            ///< reading or writing failed
    verification = 8,  ///< a law of the result does not hold
    convergence = 9,   ///< the solver did not reach its tolerance
    cancelled = 130,   ///< stopped by the user
};

enum class ElementKind : std::int32_t { vertex, edge, facet, solid };

/// Elements of one kind that an error is about, for programs; its message names the first of them for people.
struct ErrorElements {
    ElementKind kind = ElementKind::facet;
    std::vector<std::int64_t> ids;  ///< numbers as in the input, counted from 0; of an edge its two vertices
    std::vector<std::array<double, 3>> points;  ///< points at the elements, in units of the input; one for all, or one
                                                ///< for each
    std::vector<std::string> names;             ///< names of the patches or solids in which the elements lie

    template <class Archive>
    void archive(Archive& a) {
        a(kind, ids, points, names);
    }
};

/// An error. Its message says the failure, its place (element numbers of the input file, coordinates, part) and the
/// remedy, in one sentence each.
class Error : public std::runtime_error {
 public:
    Error(ErrorCode code, const std::string& message, std::vector<ErrorElements> elements = {})
        : std::runtime_error(message),
          code_(code),
          elements_(std::make_shared<const std::vector<ErrorElements>>(std::move(elements))) {}
    ErrorCode code() const { return code_; }
    /// The elements that the error is about, the worst first; empty if it is not about elements.
    const std::vector<ErrorElements>& elements() const { return *elements_; }

 private:
    ErrorCode code_;
    std::shared_ptr<const std::vector<ErrorElements>> elements_;  // copies of an exception must not throw
};

}  // namespace kerf
