#include "fit_client/fit/stages/dress_garment.h"

#include "fit_client/fit/stages/dress_bottom.h"
#include "fit_client/fit/stages/dress_top.h"

namespace fitroom {

Result<Dressing> DressGarment(const ClothMesh& cloth, GarmentKind kind, const DressedBody& wearer,
                              const DressingOptions& options, Executor& executor,
                              const std::function<void(double done)>& progress) {
  FR_RETURN_IF_ERROR(CheckLayerOrder(kind, wearer.layers));
  if (IsBottom(kind)) return DressBottom(cloth, wearer, options, executor, progress);
  return DressTop(cloth, kind, wearer, options, executor, progress);
}

}  // namespace fitroom
