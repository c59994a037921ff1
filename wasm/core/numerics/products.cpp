#include "core/numerics/products.hpp"

namespace handlebody {

MatrixXd product(const ConstMatrixRef& a, const ConstMatrixRef& b) {
  return a * b;
}

MatrixXd transposed_product(const ConstMatrixRef& a, const ConstMatrixRef& b) {
  return a.transpose() * b;
}

void multiply(const ConstMatrixRef& a, const ConstVectorRef& x, Eigen::Ref<Vector> out) {
  out.noalias() = a * x;
}

}  // namespace handlebody
