// Moving least squares (Lancaster and Salkauskas 1981): at every place x a polynomial of its own, fitted to all points by weights
// that fall with their distance from x, and the value of that polynomial there,
//
//   f(x) = p(x)ᵀa(x),    a(x) = argminₐ Σᵢ w(‖x − xᵢ‖) (p(xᵢ)ᵀa − fᵢ)²,    f(x) = Σᵢ ψᵢ(x) fᵢ.
//
// Of degree 0 with inverse distances it is Shepard's method. Polynomials of its degree are reproduced. Weights w(r):
//
//   inverse_distance   (r + ε)⁻ᵖ                  with ε = 0 singular, so that f interpolates; any ε > 0 approximates
//   gaussian           exp(−(r/h)²)               approximates
//   wendland           (1 − r/h)⁴₊ (4r/h + 1)     approximates, from the points within h only
//
// The gradient, in terms of the ψᵢ and with a(x)'s own change, is
//
//   ∇f = ∇p(x)ᵀa + Σᵢ ψᵢ ∇ln wᵢ (fᵢ − p(xᵢ)ᵀa),
//
// and at a point itself, where w is singular, its limit for p > 1: the gradient of the fit of all others through the point. There
// is no gradient (NaN) at the points for p ≤ 1 or ε > 0, which make cusps; and `wendland` has kinks where it widens.
//
// Where points are too few. What the points as a whole do not determine, as slopes across a line that all are on, is left out of
// the polynomials: polynomial_space.hpp. Locally,
//   - `wendland` widens where fewer than 2q points (q polynomials) are within 0.8 h: h becomes 1.25 times the distance of the
//   2q-th;
//   - where the points of any weight still do not determine the polynomial (to 1e-10 of their extent: on one line, say), the degree
//     falls to one that they do. Weights below 1e-400 of the largest, as of Gaussians beyond 30 widths, count as 0.
// So there is a value everywhere, continuous but where the degree changes. Of degree 1 and 2 values grow far away like the
// polynomials, and are finite within 1e100 diagonals of the data.
#pragma once

#include "core/interpolation/interpolant.hpp"
#include "core/interpolation/polynomial_space.hpp"
#include "core/numerics/graded_qr.hpp"

namespace handlebody {

enum class MovingWeight : std::uint32_t { inverse_distance = 0, gaussian = 1, wendland = 2 };
constexpr unsigned moving_weight_count = 3;

struct MovingLeastSquaresOptions {
  int degree = 1;  // 0, 1 or 2
  MovingWeight weight = MovingWeight::inverse_distance;
  double power = 4;    // p > 0, of inverse distances
  double epsilon = 0;  // ε ≥ 0, likewise, in units of the points
  double width = 0;    // h > 0 of the others, in units of the points; 0: 2 + degree mean distances to the nearest neighbor, twice
                       // that for wendland, where h is the end and not the middle of the weight
};

class MovingLeastSquares final : public Interpolant {
 public:
  /** Fails with the codes of check_data(), INVALID_OPTION, or OUT_OF_MEMORY. Points may coincide unless the weight is singular. A
   * query costs O(nq²) for q polynomials, with n the points within h for `wendland`. */
  static Result<MovingLeastSquares> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                           const MovingLeastSquaresOptions& options = {});

  /** h in units of the points, as given or chosen; 0 for inverse distances. */
  double width() const;

 private:
  MovingLeastSquares(ScatteredData data, const MovingLeastSquaresOptions& options, PolynomialSpace space);

  void weigh(const double* query, double* w, double* slopes) override;

  void find_distances(const double* query);
  void widen();
  void set_roots();
  double steepness(double r) const;
  void set_monomials(Index point);
  bool set_direction(const double* query, Index point);
  void set_slopes(const double* query, const double* w, double* slopes);

  MovingLeastSquaresOptions options_;
  double unit_;  // the data's diagonal: the unit of all lengths below
  double width_, epsilon_;
  PolynomialSpace space_;  // in diagonals
  GradedQr qr_;            // of √W P, one row for each point of any weight

  // Of the current query:
  Vector distances_;                           // n
  Index own_ = 0;                              // the nearest point, where the monomials have their origin
  double second_ = 1;                          // distance to the second nearest
  double reach_ = 1;                           // h here
  Index farthest_ = -1;                        // the point that h follows, where it widens
  Indices rows_;                               // the point of each row
  Vector roots_;                               // √w of each point, then of each row
  Vector offset_, turned_, right_, solution_;  // scratch: d, d, q, n
  Vector difference_, monomials_;              // of set_monomials()
  Vector direction_;                           // of set_direction()
  Matrix gradients_;                           // of set_slopes(), q×d
  Indices nearest_;                            // of widen()
};

}  // namespace handlebody
