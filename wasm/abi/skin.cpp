// The skinning section of handlebody.h.
#include "core/skinning/skin.hpp"

#include <memory>
#include <utility>

#include "abi/memory.hpp"
#include "abi/simplex_mesh.hpp"
#include "core/skinning/as_rigid_as_possible.hpp"
#include "core/skinning/dual_quaternion.hpp"
#include "core/skinning/linear_blend.hpp"
#include "core/skinning/quadratic_deformation.hpp"

using namespace handlebody;

struct hb_skin {
  std::unique_ptr<Skin> method;
  HeldDeformation* minimizer = nullptr;  // the method, where it is one
};

namespace {

int32_t deliver(Result<std::unique_ptr<Skin>> made, hb_skin** out) {
  if (!made) return fail(made.error());
  *out = new hb_skin{std::move(*made)};
  return HB_OK;
}

int32_t check_shape(const double* positions, const double* weights, uint32_t count, uint32_t dimension, uint32_t handle_count) {
  return check_arrays({{positions, "positions", count, dimension}, {weights, "weights", count, handle_count}});
}

WeightedShape shape(const double* positions, const double* weights, uint32_t count, uint32_t dimension, uint32_t handle_count) {
  return {positions, weights, static_cast<Index>(count), static_cast<Index>(dimension), signed_count(handle_count)};
}

}  // namespace

extern "C" {

int32_t hb_linear_blend_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights,
                               uint32_t handle_count, uint32_t compiled, hb_skin** skin) {
  handlebody::making();
  if (const int32_t status = check_shape(positions, weights, count, dimension, handle_count)) return status;
  const auto form = compiled == 0 ? LinearBlendForm::direct : LinearBlendForm::compiled;
  return deliver(linear_blend(shape(positions, weights, count, dimension, handle_count), form), skin);
}

int32_t hb_dual_quaternion_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights,
                                  uint32_t handle_count, hb_skin** skin) {
  handlebody::making();
  if (const int32_t status = check_shape(positions, weights, count, dimension, handle_count)) return status;
  return deliver(dual_quaternion_blend(shape(positions, weights, count, dimension, handle_count)), skin);
}

double* hb_skin_transforms(hb_skin* skin) {
  return skin->method->transforms();
}

int32_t hb_skin_deform(hb_skin* skin, float* positions) {
  handlebody::changing(skin);
  const auto done = skin->method->deform(positions);
  return done ? HB_OK : fail(done.error());
}

int32_t hb_minimizer_create(const hb_simplex_mesh* mesh, const hb_held_vertices* handles, uint32_t energy, hb_skin** skin) {
  handlebody::making();
  if (energy > 3) return fail({HB_ERROR_INVALID_OPTION, {"There is no energy ", energy, "."}, {"Use 0 to 3."}, HB_CULPRIT_OPTION});
  if (mesh->dimension != 2)
    return fail({HB_ERROR_INVALID_SHAPE,
                 {"Energies are minimized in the plane; the mesh has ", mesh->dimension, " dimensions."},
                 {"Give two coordinates a vertex."}});
  if (const int32_t status = check_mesh(*mesh)) return status;
  if (const int32_t status = check_held(*handles)) return status;
  auto read = read_mesh(*mesh);
  if (!read) return fail(read.error());
  auto made = energy == 3 ? as_rigid_as_possible(std::move(*read), read_held(*handles))
                          : quadratic_deformation(std::move(*read), read_held(*handles), static_cast<QuadraticEnergy>(energy));
  if (!made) return fail(made.error());
  HeldDeformation* const minimizer = made->get();
  *skin = new hb_skin{std::move(*made), minimizer};
  return HB_OK;
}

int32_t hb_minimizer_deform(hb_skin* skin, uint32_t iterations, float* positions, hb_minimizer_report* report) {
  handlebody::changing(skin);
  HeldDeformation* const minimizer = skin->minimizer;
  if (!minimizer) return fail({HB_ERROR_INVALID_OPTION, {"This skin minimizes no energy."}, {"Deform it by hb_skin_deform()."}});
  minimizer->set_iterations(iterations);
  if (const auto done = minimizer->deform(positions); !done) return fail(done.error());
  const auto [energy, taken, flips] = minimizer->report();
  *report = {energy, taken, flips};
  return HB_OK;
}

void hb_skin_free(hb_skin* skin) {
  delete skin;
  handlebody::gone(skin);
}
}
