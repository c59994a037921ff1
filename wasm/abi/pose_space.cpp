// The pose-space section of handlebody.h: checks what C cannot express, then hands over to PoseSpace.
#include "core/posespace/pose_space.hpp"

#include <limits>
#include <new>
#include <utility>

#include "abi/memory.hpp"
#include "abi/support.hpp"

struct hb_pose_space {
  handlebody::PoseSpace space;
};

namespace {

using namespace handlebody;

// Bounds of the dense system: 4096 examples are 134 MB per matrix.
constexpr uint32_t largest_count = 4096;
constexpr uint32_t largest_dimension = 64;

int32_t fail_option(const char* message, const char* remedy) {
  return fail({HB_ERROR_INVALID_OPTION, {message}, {remedy}, HB_CULPRIT_OPTION, -1});
}

int32_t fail_null(const char* what) {
  return fail({HB_ERROR_INVALID_SHAPE, {"The pointer to the ", what, " is NULL."}, {"Pass a valid pointer."}});
}

}  // namespace

extern "C" {

int32_t hb_pose_space_create(const double* places, uint32_t count, uint32_t dimension, uint32_t method, uint32_t kernel,
                             double width, int32_t degree, hb_pose_space** space) {
  handlebody::making();
  if (!space) return fail_null("result");
  if (count == 0)
    return fail({HB_ERROR_EXAMPLES_TOO_FEW, {"A pose space needs at least one example."}, {"Give one or more examples."}});
  if (count > largest_count)
    return fail({HB_ERROR_OUT_OF_MEMORY, {count, " examples are more than 4096."}, {"Use fewer examples."}});
  if (dimension == 0 || dimension > largest_dimension)
    return fail(
        {HB_ERROR_INVALID_SHAPE, {"A pose space of ", dimension, " dimensions is not supported."}, {"Use 1 to 64 dimensions."}});
  if (!places) return fail_null("places");
  if (method >= pose_space_method_count) return fail_option("The method is unknown.", "Use 0 (cardinal) or 1 (normalized).");
  if (kernel >= plain_kernel_count) return fail_option("The kernel is unknown.", "Use a number of the kernel list, 0 to 7.");

  const PoseSpaceOptions options{static_cast<PoseSpaceMethod>(method), static_cast<KernelKind>(kernel), width, degree};
  auto created = PoseSpace::create(Eigen::Map<const Matrix>(places, count, dimension), options);
  if (!created) return fail(created.error());
  auto* object = new (std::nothrow) hb_pose_space{std::move(*created)};
  if (!object) return fail({HB_ERROR_OUT_OF_MEMORY, {"There is no memory for the pose space."}, {"Use fewer examples."}});
  *space = object;
  return HB_OK;
}

int32_t hb_pose_space_weights(hb_pose_space* space, const double* query, double* weights) {
  handlebody::changing(space);
  if (!space) return fail_null("pose space");
  if (!query) return fail_null("query");
  if (!weights) return fail_null("weights");
  const Eigen::Map<const Vector> at(query, space->space.dimension());
  Eigen::Map<Vector> out(weights, space->space.size());
  if (auto done = space->space.weights(at, out); !done) return fail(done.error());
  return HB_OK;
}

void hb_pose_space_free(hb_pose_space* space) {
  delete space;
  handlebody::gone(space);
}
}
