// Surfaces with a defect made at a place that a seed chooses, and what a check must list for it.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "surface/diagnosis/diagnosis.h"

namespace kerf::test {

/// A defect with the numbers of the damaged soup.
struct ExpectedDefect {
    DefectKind kind;
    Severity severity;
    std::vector<std::int32_t> facets, vertices;
};

struct Damaged {
    Soup soup;
    std::vector<ExpectedDefect> expected;
};

/// A way of damaging a closed, outward, clean surface. Randomness decides where.
struct Damage {
    const char* name;
    Damaged (*apply)(Soup soup, std::mt19937& random);
};

/// Each makes one kind of defect, and in so far as another one follows from it, that too.
const std::vector<Damage>& all_damages();

/// Those that the repairs undo, so that the surface is what it was.
const std::vector<Damage>& mendable_damages();

/// One line per defect with kind, severity, facets and vertices; sorted.
std::vector<std::string> lines(const std::vector<ExpectedDefect>& expected);
/// The same for what a diagnosis of the soup has found, with the numbers that facets and vertices have in the file;
/// without overlaps and unlike walls of bodies, which sum up defects that have lines of their own.
std::vector<std::string> lines(const Soup& soup, const Diagnosis& diagnosis);

/// The pairs that triangles_intersect() finds among all pairs.
std::vector<ExpectedDefect> intersecting_pairs(const Soup& soup);

/// The soup with coordinates that are multiples of 2^-20, so that the middle of two vertices is exact.
Soup on_a_grid(Soup soup);

/// Each facet with vertices of its own, whose coordinates differ from its neighbours' by less than twice `jitter`.
Soup cracked(const Soup& whole, double jitter, unsigned seed);

/// Facets with all of these vertices, ascending.
std::vector<std::int32_t> facets_with(const Soup& soup, const std::vector<std::int32_t>& vertices);

void insert_facet(Soup& soup, std::int32_t place, const Triangle& facet);
void remove_facet(Soup& soup, std::int32_t facet);

}  // namespace kerf::test
