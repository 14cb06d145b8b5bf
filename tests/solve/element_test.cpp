// Laws of the elements, over random tetrahedra.
#include "solve/space/tet_element.h"

#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

class ElementLaws : public testing::TestWithParam<int> {
 protected:
    // 100 of positive volume; the same in every run.
    static std::vector<TetElement> elements() {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        std::vector<TetElement> all;
        while (all.size() < 100) {
            std::array<Vec3, 4> corners;
            for (Vec3& corner : corners) corner = {coordinate(random), coordinate(random), coordinate(random)};
            const TetElement element(corners, GetParam());
            if (element.volume() > 1e-3) all.push_back(element);
        }
        return all;
    }
    static Barycentric node(std::size_t i) {
        Barycentric place{};
        if (i < 4) place[i] = 1;
        for (int end = 0; i >= 4 && end < 2; ++end)
            place[static_cast<std::size_t>(tet_edges[i - 4][static_cast<std::size_t>(end)])] = 0.5;
        return place;
    }
    static std::size_t count() { return static_cast<std::size_t>(element_nodes(GetParam())); }
    // What the stiffness makes of displacements of the nodes.
    static std::vector<Vec3> forces(const TetElement& element, const Material& material, const std::vector<Vec3>& u) {
        TetElement::Stiffness blocks;
        element.stiffness(material, blocks);
        std::vector<Vec3> sum(count(), Vec3::Zero());
        for (std::size_t a = 0; a < count(); ++a)
            for (std::size_t b = 0; b < count(); ++b) sum[a] += blocks[a][b] * u[b];
        return sum;
    }
    const Material steel_{"steel", 210, 0.3, 1};
    const Eigen::Matrix3d slope_ = (Eigen::Matrix3d() << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3).finished();
};

INSTANTIATE_TEST_SUITE_P(Orders, ElementLaws, testing::Values(1, 2));

TEST_P(ElementLaws, ShapesAreOneAtTheirNodeAndZeroAtOthers) {
    for (std::size_t i = 0; i < count(); ++i) {
        const auto shapes = TetElement::shapes_at(GetParam(), node(i));
        for (std::size_t j = 0; j < count(); ++j) EXPECT_DOUBLE_EQ(shapes[j], i == j ? 1 : 0);
    }
}

TEST_P(ElementLaws, GradientsAreThoseOfPolynomialsOfTheirOrder) {
    const auto field = [&](const Vec3& p) -> Vec3 {
        return slope_ * p + (GetParam() == 2 ? Vec3(p.x() * p.y(), p.z() * p.z(), p.y() * p.z() - p.x() * p.x())
                                             : Vec3::Zero().eval());
    };
    for (const TetElement& element : elements())
        for (const auto& [point, weight] : quadrature::four_points) {
            std::array<Vec3, most_element_nodes> values;
            for (std::size_t i = 0; i < count(); ++i) values[i] = field(element.position_of(node(i)));
            Eigen::Matrix3d expected = slope_;
            const Vec3 p = element.position_of(point);
            if (GetParam() == 2)
                expected +=
                    (Eigen::Matrix3d() << p.y(), p.x(), 0, 0, 0, 2 * p.z(), -2 * p.x(), p.z(), p.y()).finished();
            EXPECT_LT((element.gradient_of(values, point) - expected).norm(), 1e-11 / element.volume());
        }
}

TEST_P(ElementLaws, NodesShareTheVolume) {
    for (const TetElement& element : elements()) {
        const auto volumes = element.node_volumes();
        Vec3 moment = Vec3::Zero();
        double sum = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            sum += volumes[i];
            moment += volumes[i] * element.position_of(node(i));
        }
        EXPECT_NEAR(sum, element.volume(), 1e-14);
        EXPECT_LT((moment - element.volume() * element.position_of({0.25, 0.25, 0.25, 0.25})).norm(), 1e-14);
    }
}

TEST_P(ElementLaws, RigidMotionsNeedNoForce) {
    const Vec3 moved(1, -2, 0.5), turned(0.3, 0.7, -1.1);
    for (const TetElement& element : elements()) {
        std::vector<Vec3> u;
        for (std::size_t i = 0; i < count(); ++i) u.push_back(moved + turned.cross(element.position_of(node(i))));
        for (const Vec3& force : forces(element, steel_, u)) EXPECT_LT(force.norm(), 1e-9 / element.volume());
    }
}

TEST_P(ElementLaws, UniformStrainHasItsEnergy) {
    const SymmetricTensor strain = strain_of(slope_);
    const double density = contracted(stress_of(steel_, strain), strain);
    for (const TetElement& element : elements()) {
        std::vector<Vec3> u;
        for (std::size_t i = 0; i < count(); ++i) u.push_back(slope_ * element.position_of(node(i)));
        const std::vector<Vec3> force = forces(element, steel_, u);
        double energy = 0;
        for (std::size_t i = 0; i < count(); ++i) energy += u[i].dot(force[i]);
        EXPECT_NEAR(energy / (density * element.volume()), 1, 1e-11);
    }
}

// x^a y^b z^c over a tetrahedron with three edges of length 1: a! b! c! / (a + b + c + 3)!
TEST(Elasticity, StrainAndStressAreInverse) {
    const Material material{"any", 3, 0.4, 0};
    SymmetricTensor strain;
    strain << 1, -2, 0.5, 0.25, 3, -1;
    EXPECT_LT((strain_of_stress(material, stress_of(material, strain)) - strain).norm(), 1e-14);
}

TEST(Elasticity, VonMisesIsTheStressOfATension) {
    SymmetricTensor tension, shear;
    tension << 5, 0, 0, 0, 0, 0;
    shear << 0, 0, 0, 2, 0, 0;
    EXPECT_DOUBLE_EQ(von_mises(tension), 5);
    EXPECT_DOUBLE_EQ(von_mises(shear), 2 * std::sqrt(3.0));
    tension.head<3>().array() += 7;  // a pressure does not distort
    EXPECT_DOUBLE_EQ(von_mises(tension), 5);
}

}  // namespace
}  // namespace kerf
