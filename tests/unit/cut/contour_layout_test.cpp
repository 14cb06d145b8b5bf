// Contours across walls whose edges are slanted: how they are laid out, and what is made of them.
#include "cut/cut/inside/contour_layout.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "cut/cut/inside/acceptance.h"
#include "cut/cut/inside/contour.h"
#include "cut/cut/inside/interface.h"
#include "cut/cut/inside/interface_smoothing.h"
#include "support/shapes.h"

namespace kerf {
namespace {

// A contour as the majority of the vertices gives it, across a tilted and twisted cylinder or a torus.
struct SlantedSection {
    SlantedSection(const Soup& soup, double z)
        : surface(test::to_arrays(soup)),
          band(make_band(surface, Plane(Vec3(0, 0, z), Vec3::UnitZ()))),
          side(band.majority) {
        clean_labels(surface, band, side, nullptr);
        loops = trace_loops(surface, contour_edges(surface, band, side)).loops;
        for (const auto& loop : loops) vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    ContourInPlane projected() const { return project_contour(surface, band.plane, loops); }
    bool unfold(ContourInPlane& contour) const {
        return kerf::unfold(surface, vertices, CutOptions().good_dihedral_deg, contour);
    }
    InterfaceAttempt interface(ContourLayout layout) const {
        const std::vector<std::int32_t> hits(band.vertices.size(), 0);
        return build_interface(surface, band, side, loops, hits, CutOptions(), layout);
    }

    Surface surface;
    Band band;
    Array<Facet, Side> side;
    std::vector<std::vector<Vertex>> loops;
    std::vector<Vertex> vertices;
};

template <class Body>
void for_slanted_sections(Body body) {
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "tilt and twist number " << i);
        Soup soup = test::twisted_cylinder(32, 40, 1, 8, 0.1 * (i % 10));
        const Eigen::AngleAxisd tilt(0.1 + 0.04 * i, Vec3(1, 0.3, 0).normalized());
        for (Vec3& v : soup.vertices) v = tilt * v;
        const double middle = (tilt * Vec3(0, 0, 4)).z();
        body(SlantedSection(soup, middle));
    }
}

double sharpest_turn_cosine(const ContourInPlane& contour) {
    double smallest = 1;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const Vec2 in = contour.points[i] - contour.points[contour.previous[i]];
        const Vec2 out = contour.points[contour.next[i]] - contour.points[i];
        smallest = std::min(smallest, in.normalized().dot(out.normalized()));
    }
    return smallest;
}

TEST(ContourLayout, UnfoldedContoursDoNotRunBack) {
    int spiked = 0;
    for_slanted_sections([&](const SlantedSection& section) {
        ContourInPlane contour = section.projected();
        spiked += sharpest_turn_cosine(contour) < -0.5;
        section.unfold(contour);
        EXPECT_GE(sharpest_turn_cosine(contour), -0.5);
    });
    EXPECT_GT(spiked, 5);
}

TEST(ContourLayout, PlainContoursStayWhereTheyAre) {
    for (const Soup& soup : {test::torus(3, 1, 40, 20), test::icosphere(3)}) {
        const SlantedSection section(soup, 0.03);
        ContourInPlane contour = section.projected();
        const std::vector<Vec2> before = contour.points;
        const bool unfolded = section.unfold(contour);
        EXPECT_EQ(contour.points != before, unfolded);
        EXPECT_EQ(section.interface(ContourLayout::unfolded).refusal == Refusal::none, unfolded);
    }
}

TEST(ContourLayout, UnfoldedInterfacesMeetTheContourAndAreValid) {
    int accepted = 0, projected = 0, sections = 0;
    for_slanted_sections([&](const SlantedSection& section) {
        ++sections;
        const auto is_valid = [&](const InterfaceAttempt& attempt) {
            if (attempt.refusal != Refusal::none) return false;
            const Verdict verdict = judge_interface(section.surface, section.band, attempt.interface, CutOptions());
            return verdict.refusal == Refusal::none || verdict.refusal == Refusal::soft;
        };
        const InterfaceAttempt unfolded = section.interface(ContourLayout::unfolded);
        for (std::size_t i = 0; i < unfolded.interface.contour.size() && unfolded.refusal == Refusal::none; ++i)
            EXPECT_EQ(unfolded.interface.points[i], section.surface.point(unfolded.interface.contour[i]));
        accepted += is_valid(unfolded);
        projected += is_valid(section.interface(ContourLayout::projected));
    });
    EXPECT_GE(accepted, sections * 3 / 4);
    EXPECT_GT(accepted, projected);
}

TEST(InterfaceSmoothing, RaisesTheWorstAndKeepsTheContour) {
    for_slanted_sections([](const SlantedSection& section) {
        for (const ContourLayout layout : {ContourLayout::projected, ContourLayout::unfolded}) {
            const InterfaceAttempt attempt = section.interface(layout);
            if (attempt.refusal != Refusal::none) continue;
            Interface smoothed = attempt.interface;
            smooth_interface(section.surface, CutOptions(), smoothed);
            EXPECT_EQ(smoothed.triangles, attempt.interface.triangles);
            for (std::size_t i = 0; i < smoothed.contour.size(); ++i)
                EXPECT_EQ(smoothed.points[i], attempt.interface.points[i]);
            const Verdict before = judge_interface(section.surface, section.band, attempt.interface, CutOptions());
            const Verdict after = judge_interface(section.surface, section.band, smoothed, CutOptions());
            if (before.refusal != Refusal::soft || after.refusal == Refusal::intersection) continue;
            const CutOptions options;
            const auto worst = [&](const InterfaceQuality& quality) {
                return std::min({1.0, quality.angle_deg / options.good_angle_deg,
                                 quality.dihedral_deg / options.good_dihedral_deg});
            };
            EXPECT_GE(worst(after.quality), worst(before.quality));
        }
    });
}

}  // namespace
}  // namespace kerf
