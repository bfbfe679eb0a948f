#pragma once

// The parts of the text report that say how a garment fits. Private to fit_client/report.

#include "fit_client/report/fit_report.h"
#include "fit_client/report/page.h"

namespace fitroom {

// The shopper's part: verdict, which size to take, all sizes, layers. Nothing where nothing was judged.
void WriteVerdictText(const FitReport& report, Page& page);

// The engineer's part: girths, ease, strain and pressure of each zone, and how the garment's measures are known.
void WriteZonesText(const FitReport& report, Page& page);

}  // namespace fitroom
