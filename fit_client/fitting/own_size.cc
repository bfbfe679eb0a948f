#include "fit_client/fitting/own_size.h"

namespace fitroom {

Result<SizeChoice> ChooseOwnSize(const Garment& garment, const Body& body) {
  BodyGirths girths;
  girths.bust = body.measurements.bust.girth;
  girths.waist = body.measurements.waist.girth;
  girths.hip = body.measurements.hip.girth;
  Result<SizeChoice> choice = ChooseSize(garment.kind, garment.fabric, garment.chart, girths);
  if (!choice.ok()) return choice.status().At(garment.id);
  return choice;
}

}  // namespace fitroom
