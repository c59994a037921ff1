// The skinning section of handlebody.h.
#include "core/skinning/skin.hpp"

#include <memory>
#include <utility>

#include "abi/support.hpp"
#include "core/skinning/dual_quaternion.hpp"
#include "core/skinning/linear_blend.hpp"

using namespace handlebody;

struct hb_skin {
  std::unique_ptr<Skin> method;
};

namespace {

int32_t deliver(Result<std::unique_ptr<Skin>> made, hb_skin** out) {
  if (!made) return fail(made.error());
  *out = new hb_skin{std::move(*made)};
  return HB_OK;
}

WeightedShape shape(const double* positions, const double* weights, uint32_t count, uint32_t dimension, uint32_t handle_count) {
  return {positions, weights, static_cast<Index>(count), static_cast<Index>(dimension), static_cast<Index>(handle_count)};
}

}  // namespace

extern "C" {

int32_t hb_linear_blend_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights,
                               uint32_t handle_count, uint32_t compiled, hb_skin** skin) {
  const auto form = compiled == 0 ? LinearBlendForm::direct : LinearBlendForm::compiled;
  return deliver(linear_blend(shape(positions, weights, count, dimension, handle_count), form), skin);
}

int32_t hb_dual_quaternion_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights,
                                  uint32_t handle_count, hb_skin** skin) {
  return deliver(dual_quaternion_blend(shape(positions, weights, count, dimension, handle_count)), skin);
}

double* hb_skin_transforms(hb_skin* skin) {
  return skin->method->transforms();
}

int32_t hb_skin_deform(hb_skin* skin, float* positions) {
  const auto done = skin->method->deform(positions);
  return done ? HB_OK : fail(done.error());
}

void hb_skin_free(hb_skin* skin) {
  delete skin;
}
}
