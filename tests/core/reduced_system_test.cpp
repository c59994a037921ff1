#include "core/irbf/reduced_system.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

using namespace handlebody;

namespace {

constexpr Index unknowns = 14, edges = 18, constraints = 5;
constexpr double smoothness = 1e-3, mu = 100;

struct Setup {
  MatrixXd edge_rows, rows, regularized;  // the last: Z₁ᵀZ₁ + λ on the coefficients
  MatrixXd right;                         // Γ₁ over T

  explicit Setup(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto number = [&] { return normal(random); };
    edge_rows = MatrixXd::NullaryExpr(edges, unknowns, number);
    edge_rows.col(3).setZero();  // a translation cancels in an edge
    rows = MatrixXd::NullaryExpr(constraints, unknowns, number);
    right = MatrixXd::NullaryExpr(edges + constraints, 3, number);
    regularized = edge_rows.transpose() * edge_rows;
    regularized.diagonal().tail(unknowns - 4).array() += smoothness;
  }

  double energy(const MatrixXd& solution) const {
    return (edge_rows * solution - right.topRows(edges)).squaredNorm() +
           smoothness * solution.bottomRows(unknowns - 4).squaredNorm();
  }
};

MatrixXd weighted(const Setup& setup, double weight) {
  MatrixXd right = setup.right;
  right.bottomRows(constraints) *= weight;
  return right;
}

}  // namespace

TEST_CASE("soft constraints: the normal equations of the appendix, by Eigen's LU (seeds 1 to 5)") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Setup setup(seed);
    const auto system = make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, mu, ConstraintKind::soft);
    REQUIRE(system);
    const MatrixXd normal = setup.regularized + mu * mu * setup.rows.transpose() * setup.rows;
    const MatrixXd expected = normal.fullPivLu().solve(setup.edge_rows.transpose() * setup.right.topRows(edges) +
                                                       mu * mu * setup.rows.transpose() * setup.right.bottomRows(constraints));
    const MatrixXd right = weighted(setup, system->weight), solution = system->inverse * right;
    CHECK((solution - expected).norm() < 1e-9 * expected.norm());
    CHECK((system->hat.topRows(edges) * right - setup.edge_rows * expected).norm() < 1e-9 * expected.norm());
    const double energy =
        setup.energy(expected) + mu * mu * (setup.rows * expected - setup.right.bottomRows(constraints)).squaredNorm();
    CHECK((right.array() * (right - system->hat * right).array()).sum() == doctest::Approx(energy).epsilon(1e-8));
    // The estimate is a lower bound, mostly within a factor of three.
    const double condition = normal.cwiseAbs().colwise().sum().maxCoeff() * normal.inverse().cwiseAbs().colwise().sum().maxCoeff();
    CHECK(system->condition < 1.01 * condition);
    CHECK(system->condition > condition / 5);
  }
}

TEST_CASE("hard constraints: Lagrange multipliers (§4.6), by Eigen's LU on the saddle point system (seeds 1 to 5)") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Setup setup(seed);
    const auto system = make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, mu, ConstraintKind::hard);
    REQUIRE(system);
    MatrixXd saddle = MatrixXd::Zero(unknowns + constraints, unknowns + constraints);
    saddle.topLeftCorner(unknowns, unknowns) = setup.regularized;
    saddle.topRightCorner(unknowns, constraints) = setup.rows.transpose();
    saddle.bottomLeftCorner(constraints, unknowns) = setup.rows;
    MatrixXd right(unknowns + constraints, 3);
    right.topRows(unknowns) = setup.edge_rows.transpose() * setup.right.topRows(edges);
    right.bottomRows(constraints) = setup.right.bottomRows(constraints);
    const MatrixXd expected = saddle.fullPivLu().solve(right).topRows(unknowns);
    const MatrixXd given = weighted(setup, system->weight), solution = system->inverse * given;
    CHECK((solution - expected).norm() < 1e-8 * expected.norm());
    CHECK((setup.rows * solution - setup.right.bottomRows(constraints)).norm() < 1e-10);
    CHECK((given.array() * (given - system->hat * given).array()).sum() == doctest::Approx(setup.energy(expected)).epsilon(1e-6));
  }
}

TEST_CASE("soft constraints come to agree with hard ones as their weight grows, like 1/μ² (seed 6)") {
  const Setup setup(6);
  const auto hard = make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, mu, ConstraintKind::hard);
  REQUIRE(hard);
  const MatrixXd exact = hard->inverse * weighted(setup, hard->weight);
  double last = 0;
  for (const double weight : {10.0, 100.0, 1000.0}) {
    const auto soft = make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, weight, ConstraintKind::soft);
    REQUIRE(soft);
    const double difference = (soft->inverse * weighted(setup, soft->weight) - exact).norm();
    if (last > 0) CHECK(last / difference == doctest::Approx(100).epsilon(0.1));
    last = difference;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("hard constraints that repeat, or are more than the unknowns, are refused") {
  Setup setup(7);
  setup.rows.row(4) = setup.rows.row(1);
  const auto repeated = make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, mu, ConstraintKind::hard);
  REQUIRE_FALSE(repeated);
  CHECK(repeated.error().code == HB_ERROR_SYSTEM_SINGULAR);
  CHECK(make_reduced_system(setup.edge_rows, setup.regularized, setup.rows, mu, ConstraintKind::soft));
  const MatrixXd many = MatrixXd::Random(unknowns + 1, unknowns);
  CHECK_FALSE(make_reduced_system(setup.edge_rows, setup.regularized, many, mu, ConstraintKind::hard));
}
