// The skinning-weights section of handlebody.h.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "abi/memory.hpp"
#include "abi/simplex_mesh.hpp"
#include "core/skinning/bounded_weights.hpp"
#include "core/skinning/measure_weights.hpp"
#include "core/skinning/polyharmonic_weights.hpp"

using namespace handlebody;

struct hb_skinning_weights {
  std::unique_ptr<PolyharmonicWeights> weights;
  std::unique_ptr<BoundedWeights> bounding;
  Matrix bounded;  // empty where the weights are not bounded
};

static_assert(sizeof(Island) == sizeof(hb_island));

extern "C" {

int32_t hb_skinning_weights_create(const hb_simplex_mesh* mesh, uint32_t order, uint32_t mass, hb_skinning_weights** out) {
  handlebody::making();
  if (order < 1 || order > 3 || mass >= mass_count) {
    return fail({HB_ERROR_INVALID_OPTION,
                 {"The order ", order, " or the mass ", mass, " is unknown."},
                 {"Use those that the header lists."},
                 HB_CULPRIT_OPTION});
  }
  if (const int32_t status = check_mesh(*mesh)) return status;
  auto read = read_mesh(*mesh);
  if (!read) return fail(read.error());
  auto made = PolyharmonicWeights::create(std::move(*read), static_cast<int>(order), static_cast<Mass>(mass));
  if (!made) return fail(made.error());
  *out = new hb_skinning_weights{std::move(*made), nullptr, {}};
  return HB_OK;
}

int32_t hb_skinning_weights_set_handles(hb_skinning_weights* weights, const hb_held_vertices* handles) {
  handlebody::changing(weights);
  if (const int32_t status = check_held(*handles)) return status;
  const auto done = weights->weights->set_handles(read_held(*handles));
  if (!done) return fail(done.error());
  weights->bounding.reset();
  weights->bounded.resize(0, 0);
  return HB_OK;
}

const double* hb_skinning_weights_values(hb_skinning_weights* weights) {
  return weights->bounded.size() > 0 ? weights->bounded.data() : weights->weights->weights().data();
}

uint32_t hb_skinning_weights_factored(hb_skinning_weights* weights) {
  return weights->weights->factored() ? 1 : 0;
}

uint32_t hb_skinning_weights_islands(hb_skinning_weights* weights, const hb_island** islands) {
  *islands = reinterpret_cast<const hb_island*>(weights->weights->islands().data());
  return static_cast<uint32_t>(weights->weights->islands().size());
}

const double* hb_skinning_weights_mass(hb_skinning_weights* weights) {
  return weights->weights->mass().data();
}

uint32_t hb_skinning_weights_energy(hb_skinning_weights* weights, hb_sparse_matrix* out) {
  const SparseMatrix& energy = weights->weights->energy();
  *out = {reinterpret_cast<const uint32_t*>(energy.outerIndexPtr()), reinterpret_cast<const uint32_t*>(energy.innerIndexPtr()),
          energy.valuePtr()};
  return static_cast<uint32_t>(energy.nonZeros());
}

int32_t hb_skinning_weights_bound_begin(hb_skinning_weights* weights, double tolerance) {
  handlebody::changing(weights);
  if (!(tolerance > 0 && tolerance < 1))
    return fail({HB_ERROR_INVALID_OPTION,
                 {"The tolerance ", tolerance, " is not between 0 and 1."},
                 {"Give a part of the energy, such as 1e-6."},
                 HB_CULPRIT_OPTION});
  const PolyharmonicWeights& from = *weights->weights;
  if (from.weights().size() == 0)
    return fail({HB_ERROR_HANDLES_MISSING, {"There are no weights to bound before handles are set."}, {"Set handles first."}});
  BoundedWeightsOptions options;
  options.tolerance = tolerance;
  auto made = BoundedWeights::create(from.energy(), from.mass(), from.held(), from.weights(), options);
  if (!made) return fail(made.error());
  weights->bounding = std::move(*made);
  return HB_OK;
}

int32_t hb_skinning_weights_bound_step(hb_skinning_weights* weights, double* progress, hb_bounded_report* report) {
  handlebody::changing(weights);
  if (!weights->bounding) {
    *progress = 1;
    return HB_OK;
  }
  *progress = weights->bounding->step();
  const BoundedWeightsReport& own = weights->bounding->report();
  *report = {own.energy, own.gap, static_cast<uint32_t>(own.sweeps), static_cast<uint32_t>(own.newton_steps)};
  if (!weights->bounding->done()) return HB_OK;
  weights->bounded = weights->bounding->weights();
  weights->bounding.reset();
  return HB_OK;
}

void hb_skinning_weights_free(hb_skinning_weights* weights) {
  delete weights;
  handlebody::gone(weights);
}

int32_t hb_measure_weights(const hb_simplex_mesh* mesh, const hb_held_vertices* handles, const double* weights, double* support,
                           hb_weight_measures* measures) {
  handlebody::making();
  if (const int32_t status = check_mesh(*mesh)) return status;
  if (const int32_t status = check_held(*handles)) return status;
  if (const int32_t status = check_arrays({{weights, "weights", mesh->vertex_count, handles->handle_count}})) return status;
  auto read = read_mesh(*mesh);
  if (!read) return fail(read.error());
  const Eigen::Map<const Matrix> given(weights, static_cast<Index>(mesh->vertex_count), signed_count(handles->handle_count));
  const auto made = measure_weights(*read, read_held(*handles), given);
  if (!made) return fail(made.error());
  std::copy(made->support.data(), made->support.data() + made->support.size(), support);
  *measures = {made->gradient_jump, made->far_weight, made->leaked_weight, made->sum_error, made->least, made->largest};
  return HB_OK;
}
}
