// Isotropic linear elasticity: the stress of a strain, and the strain of a stress.
#pragma once

#include <string>

#include <Eigen/Core>

namespace kerf {

/// Stress or strain in VTK's order: XX YY ZZ XY YZ XZ. Shear strains are halves of the engineering ones.
using SymmetricTensor = Eigen::Matrix<double, 6, 1>;

/// A linear elastic material in any consistent units: young [force / length^2], density [mass / length^3].
struct Material {
    std::string name;
    double young = 1;      ///< > 0
    double poisson = 0;    ///< in (-1, 1/2)
    double density = 0;    ///< >= 0
    double expansion = 0;  ///< thermal, of lengths [1 / temperature]; >= 0
    double yield = 0;      ///< stress [force / length^2]; 0: not known

    /// Lame's constants.
    double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
    double mu() const { return young / (2 * (1 + poisson)); }
};

/// Returns the symmetric part of the gradient of displacement; row i of `gradient` is that of component i.
inline SymmetricTensor strain_of(const Eigen::Matrix3d& gradient) {
    SymmetricTensor strain;
    strain << gradient(0, 0), gradient(1, 1), gradient(2, 2), 0.5 * (gradient(0, 1) + gradient(1, 0)),
        0.5 * (gradient(1, 2) + gradient(2, 1)), 0.5 * (gradient(0, 2) + gradient(2, 0));
    return strain;
}

inline SymmetricTensor stress_of(const Material& material, const SymmetricTensor& strain) {
    SymmetricTensor stress = 2 * material.mu() * strain;
    stress.head<3>().array() += material.lambda() * strain.head<3>().sum();
    return stress;
}

inline SymmetricTensor strain_of_stress(const Material& material, const SymmetricTensor& stress) {
    SymmetricTensor strain = (1 + material.poisson) / material.young * stress;
    strain.head<3>().array() -= material.poisson / material.young * stress.head<3>().sum();
    return strain;
}

/// Returns the scalar product of two tensors, in which each shear counts twice.
inline double contracted(const SymmetricTensor& a, const SymmetricTensor& b) {
    return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

/// Returns the stress of a uniaxial tension that distorts as much (von Mises 1913, vonmises1913).
double von_mises(const SymmetricTensor& stress);

}  // namespace kerf
