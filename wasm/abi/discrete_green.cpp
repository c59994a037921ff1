// The section of handlebody.h on discrete Green's functions.
#include "core/interpolation/discrete_green.hpp"

#include <algorithm>
#include <utility>

#include "abi/memory.hpp"
#include "abi/support.hpp"

using namespace handlebody;

struct hb_discrete_green {
  DiscreteGreen green;
};

extern "C" {

int32_t hb_discrete_green_create(uint32_t size, uint32_t order, uint32_t boundary, const uint32_t* samples, const double* values,
                                 uint32_t sample_count, hb_discrete_green** out) {
  handlebody::making();
  if (!out) return fail({HB_ERROR_INVALID_SHAPE, {"The pointer to the result is NULL."}, {"Pass a valid pointer."}});
  if (const int32_t status = check_arrays({{samples, "samples", sample_count}, {values, "values", sample_count}})) return status;
  if (boundary >= grid_boundary_count)
    return fail({HB_ERROR_INVALID_OPTION,
                 {"There is no boundary ", boundary, "."},
                 {"Use 0 (free), 1 (Dirichlet), 2 (Neumann) or 3 (periodic)."},
                 HB_CULPRIT_OPTION});
  auto made = DiscreteGreen::create(signed_count(size), signed_count(order), static_cast<GridBoundary>(boundary), samples, values,
                                    static_cast<Index>(sample_count));
  if (!made) return fail(made.error());
  *out = new hb_discrete_green{std::move(*made)};
  return HB_OK;
}

int32_t hb_discrete_green_shape(hb_discrete_green* green, uint32_t* rows, uint32_t* nullity) {
  handlebody::changing(green);
  *rows = static_cast<uint32_t>(green->green.difference().rows());
  *nullity = static_cast<uint32_t>(green->green.null_space().cols());
  return HB_OK;
}

int32_t hb_discrete_green_matrix(hb_discrete_green* green, uint32_t which, double* out) {
  handlebody::changing(green);
  const auto copy = [out](const Matrix& matrix) { std::copy(matrix.data(), matrix.data() + matrix.size(), out); };
  const DiscreteGreen& made = green->green;
  switch (which) {
    case 0:
      copy(made.difference());
      return HB_OK;
    case 1:
      copy(made.squared());
      return HB_OK;
    case 2:
      copy(made.null_space());
      return HB_OK;
    case 3:
      copy(made.green());
      return HB_OK;
    default:
      return fail({HB_ERROR_INVALID_OPTION, {"There is no matrix ", which, "."}, {"Use 0 to 3."}, HB_CULPRIT_OPTION});
  }
}

int32_t hb_discrete_green_solve_grid(hb_discrete_green* green, double* out) {
  handlebody::changing(green);
  green->green.solve_grid(out);
  return HB_OK;
}

int32_t hb_discrete_green_solve_radial(hb_discrete_green* green, double* out, double* weights) {
  handlebody::changing(green);
  green->green.solve_radial(out, weights);
  return HB_OK;
}

void hb_discrete_green_free(hb_discrete_green* green) {
  delete green;
  handlebody::gone(green);
}
}
