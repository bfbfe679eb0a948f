#pragma once

#include <string>
#include <vector>

#include "common/body/body.h"
#include "common/garment/garment.h"
#include "fit_client/fit/measure/zones.h"

namespace fitroom {

// How a garment fits at one zone. Lengths in metres; girths of the thigh, knee and trouser hem are of one leg; the
// shoulder's "girths" are breadths. What was not measured is zero.
struct ZoneFit {
  FitZone zone = FitZone::kBust;
  bool measured = false;       // False: `note` says why; the girths mean nothing.
  double height = 0.0;         // Of the garment's line when worn, or of the body's when it was not worn.
  double body_girth = 0.0;     // What a tape measures.
  double garment_girth = 0.0;  // Of the flat garment, twice its width: what it has to give.
  double worn_girth = 0.0;     // The same line of the cloth as worn; longer where it is stretched. 0: not worn.
  // The least that the worn line can measure: of front and back each its flat length, or the way round body and layers
  // from seam to seam where that is longer. 0: not known.
  double least_worn_girth = 0.0;
  bool is_belted = false;      // A belt holds the worn line at least_worn_girth, however long it is when flat.
  double layered_girth = 0.0;  // A tape round the body and what is worn below, at this line; 0: nothing is.
  Provenance provenance = Provenance::kMeasured;  // Of the garment's girth.

  bool has_strain = false;
  double strain_mean = 0.0;   // Of the triangles' largest principal strain, weighted by area (unit: 1).
  double strain_p95 = 0.0;    // (unit: 1)
  double strain_max = 0.0;    // (unit: 1)
  double strain_angle = 0.0;  // Main direction in the flat garment: 0 round the body, 90 degrees along (unit: radian).

  double contact_share = 0.0;     // Part of the zone's cloth that lies on the body.
  double laplace_pressure = 0.0;  // Mean where it lies on the body (unit: Pa).
  double contact_pressure = 0.0;  // The same from the balance of forces (unit: Pa).
  double gap_mean = 0.0;          // From the body to the zone's cloth.
  std::string note;

  double ease() const { return garment_girth - body_girth; }
  double worn_ease() const { return worn_girth - body_girth; }
  double relative_ease() const { return body_girth > 0.0 ? ease() / body_girth : 0.0; }
  // By how much the garment has to stretch to go round the body; never negative (unit: 1).
  double needed_strain() const;
};

// Returns the fit of the flat garment alone, from its measures, without wearing it: for the sizes that are not
// dressed. Zones whose measure is missing come back with provenance kUnknown and are not measured.
std::vector<ZoneFit> ZonesFromMeasures(GarmentKind kind, const std::vector<GarmentMeasure>& measures, const Body& body);

// Returns how a zone's garment girth is known: kUnknown where the garment has legs, the zone is the thigh and its
// measure is absent, because folding hides it; kMeasured where the panels show it.
Provenance ZoneProvenance(GarmentKind kind, FitZone zone, const std::vector<GarmentMeasure>& measures);

// Returns the dimensions beside the zones that decide whether a garment of this kind fits and that these measures do
// not know, in a shopper's words: "front rise", "back rise" of trousers whose fork folding hides. For
// VerdictInput::unknown.
std::vector<std::string> UnknownDimensions(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

}  // namespace fitroom
