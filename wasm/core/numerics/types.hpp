// The matrix types that the core shares. Points and coefficients are row-major: one row per point, as in the typed arrays outside.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace handlebody {

using Index = Eigen::Index;

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using MatrixXd = Eigen::MatrixXd;  // column-major, as decompositions want it
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** n×3 positions, one row per point. */
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using PointsF = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/** Three columns x, y, z, each contiguous, for products of a matrix with one column after the other. With all three at once Eigen's
 * blocked product would pack the matrix first, which takes twice the time and allocates. */
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/** m×3 vertex indices, counter-clockwise seen from outside. */
using Triangles = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

using ConstPoints = Eigen::Ref<const Points>;
using ConstTriangles = Eigen::Ref<const Triangles>;

}  // namespace handlebody
