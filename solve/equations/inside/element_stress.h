// Strains and stresses inside of one element.
#pragma once

#include <array>
#include <vector>

#include "solve/equations/elastic_problem.h"

namespace kerf {

class ElementStress {
 public:
    /// Takes tetrahedron `t` of the part `p` of this rank, in case `number`. `displacement`: 3 for each local node.
    ElementStress(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number,
                  std::size_t p, std::size_t t)
        : element_(problem.space->element(p, t)),
          material_(problem.material(p, t)),
          thermal_(problem.thermal_strain(number, p, t)) {
        const auto nodes = problem.space->nodes_of(p, t);
        for (int i = 0; i < element_.node_count(); ++i)
            values_[i] = Eigen::Map<const Vec3>(&displacement[3 * nodes[i]]);
    }
    const TetElement& element() const { return element_; }
    const Material& material() const { return material_; }
    /// Returns the mechanical strain, which is the strain without the thermal one.
    SymmetricTensor strain(const Barycentric& place) const { return mechanical(element_.gradient_of(values_, place)); }
    SymmetricTensor strain(const TetElement::Point& point) const {
        Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
        for (int n = 0; n < element_.node_count(); ++n)
            gradient.noalias() += values_[n] * point.gradients[n].transpose();
        return mechanical(gradient);
    }
    SymmetricTensor stress(const Barycentric& place) const { return stress_of(material_, strain(place)); }
    /// Returns the nodal forces that balance the stresses.
    std::array<Vec3, most_element_nodes> nodal_forces() const {
        std::array<Vec3, most_element_nodes> forces;
        forces.fill(Vec3::Zero());
        for (const TetPoint& at : element_.rule()) {
            const TetElement::Point point = element_.point(at);
            const SymmetricTensor s = stress_of(material_, strain(point));
            Eigen::Matrix3d matrix;
            matrix << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
            for (int n = 0; n < element_.node_count(); ++n) forces[n] += point.weight * matrix * point.gradients[n];
        }
        return forces;
    }

 private:
    SymmetricTensor mechanical(const Eigen::Matrix3d& gradient) const {
        SymmetricTensor strain = strain_of(gradient);
        strain.head<3>().array() -= thermal_;
        return strain;
    }

    TetElement element_;
    const Material& material_;
    double thermal_;
    TetElement::Nodes values_;
};

}  // namespace kerf
