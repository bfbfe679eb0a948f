// Dresses a population: every body in every outfit, each garment in the size of its chart that the body's primary
// dimension names, or so many steps smaller or larger. Prints a line a garment and a table an outfit.
//   population_bench --bodies FOLDER --garments FOLDER [--every N] [--step N] [--outfit NAME[+NAME]]... [--pitch-cm
//   P]... [--threads N] [--all-sizes] [--body NAME]... [--zones] [--check]
// FOLDER of garments: one folder a garment, as `shop_catalog extract` makes it, named as in the outfits.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/base/executor.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/fit_outfit.h"
#include "fit_client/fitting/own_size.h"
#include "tests/bench/ease_table.h"

namespace fitroom {
namespace {

struct Flags {
  std::string bodies, garments;
  std::vector<std::string> outfits = {"tshirt", "one_piece", "skirt", "pants", "pants+tshirt"};
  int every = 1;
  int step = 0;
  int threads = 2;
  std::vector<double> pitches_cm = {1.0};
  bool no_self_collision = false;
  bool one_mesh = false;
  bool check = false;
  bool all_sizes = false;
  bool zones = false;
  std::vector<std::string> names;
};

// What came out of one garment of one outfit on one body.
struct Row {
  std::string body, outfit, garment, size;
  std::string reason;  // Of the report, or the error's.
  std::string text;
  bool finished = false;
  bool stated = false;  // It ended with an outcome, not with an error.
  bool torn = false;    // A particle is nowhere, or an edge is three times as long as at rest.
  double deepest = 0.0;
  int inside = 0;
  double seam_max = 0.0;
  double strain_p95 = 0.0;
  double strain_max = 0.0;
  double ease_error = 0.0;  // Largest difference of a torso zone's worn line from what it has to be.
  double belt_ease = 0.0;   // Of a bottom's waist, before it was held (unit: metre).
  int crossings = 0;
  int substeps = 0;
  double pitch_cm = 0.0;
  std::vector<ZoneFit> zones;
  double seconds = 0.0;  // Of one thread's work, whatever else the machine does.
};

double ThreadSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double LargestStretch(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& places) {
  double largest = 0.0;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (int k = 0; k < 3; ++k) {
      const size_t a = static_cast<size_t>(triangle[k]);
      const size_t b = static_cast<size_t>(triangle[(k + 1) % 3]);
      const double stretch =
          (places[a] - places[b]).norm() / (cloth.rest_positions[a] - cloth.rest_positions[b]).norm();
      if (!(stretch <= largest)) largest = stretch;
    }
  }
  return largest;
}

std::vector<std::string> GarmentsOf(const std::string& outfit) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin <= outfit.size();) {
    const size_t end = std::min(outfit.find('+', begin), outfit.size());
    names.push_back(outfit.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

Result<std::string> SizeFor(const Garment& garment, const Body& body, int step) {
  if (garment.chart.sizes.empty()) return std::string();
  Garment as_sold = garment;  // Without the sizes that ExtendChart() added.
  std::erase_if(as_sold.chart.sizes,
                [](const GarmentSize& size) { return size.name[0] == '<' || size.name[0] == '>'; });
  FR_ASSIGN_OR_RETURN(const SizeChoice choice, ChooseOwnSize(as_sold, body));
  const std::string& chosen = as_sold.chart.sizes[static_cast<size_t>(choice.index)].name;
  const std::vector<GarmentSize>& sizes = garment.chart.sizes;
  const auto at =
      std::find_if(sizes.begin(), sizes.end(), [&](const GarmentSize& size) { return size.name == chosen; });
  const int last = static_cast<int>(sizes.size()) - 1;
  return sizes[static_cast<size_t>(std::clamp(static_cast<int>(at - sizes.begin()) + step, 0, last))].name;
}

// One size more at an end of a chart: as far from the last one as that is from its neighbour.
GarmentSize SizeBeyond(const GarmentSize& neighbour, const GarmentSize& last) {
  GarmentSize beyond = last;
  const auto go_on = [](const std::vector<GarmentMeasure>& from, std::vector<GarmentMeasure>& measures) {
    for (GarmentMeasure& measure : measures) {
      const GarmentMeasure* before = FindMeasure(from, measure.name);
      if (before != nullptr) measure.value += measure.value - before->value;
    }
  };
  go_on(neighbour.measures, beyond.measures);
  go_on(neighbour.body, beyond.body);
  return beyond;
}

// Bodies at an end of the chart are to get a garment that is really so many steps off: the chart goes on as it ends.
void ExtendChart(int steps, SizeChart& chart) {
  if (chart.sizes.size() < 2) return;
  for (int step = 1; step <= std::abs(steps); ++step) {
    const size_t count = chart.sizes.size();
    GarmentSize beyond = steps < 0 ? SizeBeyond(chart.sizes[1], chart.sizes[0])
                                   : SizeBeyond(chart.sizes[count - 2], chart.sizes[count - 1]);
    beyond.name = (steps < 0 ? "<" : ">") + std::to_string(step);
    chart.sizes.insert(steps < 0 ? chart.sizes.begin() : chart.sizes.end(), beyond);
  }
}

Row MakeRow(const FittedGarment& fitted) {
  Row row;
  row.size = fitted.cut.size;
  const FitReport& report = fitted.report;
  row.reason = report.finishing_reason;
  row.text = report.finishing_text;
  row.finished = report.finished;
  row.stated = !report.finishing_reason.empty();
  row.torn = !(LargestStretch(fitted.cut.cloth, fitted.stages.final) < 3.0);
  row.deepest = report.penetration.deepest;
  row.inside = report.penetration.particle_count_inside + report.penetration.triangle_sample_count_inside;
  row.seam_max = report.seams.max;
  row.strain_p95 = report.strain.p95;
  row.strain_max = report.strain.max;
  row.crossings = report.self_crossing_count;
  row.substeps = report.substep_count;
  row.zones = report.zones;
  if (fitted.bottom) row.belt_ease = fitted.bottom->belt.ease();
  for (const ZoneFit& zone : report.zones) {
    const bool is_torso = zone.zone == FitZone::kBust || zone.zone == FitZone::kWaist || zone.zone == FitZone::kHip;
    if (!is_torso || !zone.measured || zone.worn_girth <= 0.0) continue;
    row.ease_error = std::max(row.ease_error, std::abs(LineError(zone)));
  }
  return row;
}

// `outermost_size`: of the garment worn outermost; empty: the one that the body asks for, as for the others.
std::vector<Row> FitOne(const std::filesystem::path& body_file, const BodyInput& body, const std::string& outfit_name,
                        const std::map<std::string, GarmentInput>& wardrobe, double pitch_cm,
                        const std::string& outermost_size, const Flags& flags) {
  std::vector<Row> rows;
  std::vector<Layer> layers;
  for (const std::string& name : GarmentsOf(outfit_name)) {
    const GarmentInput& garment = wardrobe.at(name);
    const Result<std::string> size = SizeFor(garment.garment, body.body, flags.step);
    layers.push_back({&garment, size.ok() ? *size : std::string()});
  }
  if (!outermost_size.empty()) layers.back().size = outermost_size;
  SerialExecutor executor;
  Stopwatch stopwatch;
  FitOptions options;
  options.pitch = 0.01 * pitch_cm;
  options.dressing.drape.self_collision = !flags.no_self_collision;
  options.coarse_to_fine = !flags.one_mesh;
  const double begin = ThreadSeconds();
  const Result<Outfit> outfit = FitOutfit(body, layers, options, executor, stopwatch, {});
  const double seconds = ThreadSeconds() - begin;
  if (outfit.ok()) {
    for (const FittedGarment& fitted : outfit->garments) {
      rows.push_back(MakeRow(fitted));
      rows.back().garment = fitted.input->garment.id;
    }
  } else {
    Row row;
    row.reason = outfit.status().reason();
    row.text = outfit.status().message();
    rows.push_back(row);
  }
  for (Row& row : rows) {
    row.body = body_file.stem().string();
    row.outfit = outfit_name;
    row.pitch_cm = pitch_cm;
    row.seconds = seconds / static_cast<double>(rows.size());
  }
  return rows;
}

void PrintRow(const Row& row) {
  std::printf(
      "%-6s %3.1f cm %-14s %-12s %-4s %-26s deepest %5.2f mm inside %4d seam %5.2f mm strain95 %5.1f %% max %5.1f %% "
      "ease %5.1f mm cross %4d steps %6d %6.2f s%s\n",
      row.body.c_str(), row.pitch_cm, row.outfit.c_str(), row.garment.c_str(), row.size.c_str(), row.reason.c_str(),
      row.deepest * 1e3, row.inside, row.seam_max * 1e3, row.strain_p95 * 1e2, row.strain_max * 1e2,
      row.ease_error * 1e3, row.crossings, row.substeps, row.seconds, row.torn ? " TORN" : "");
  if (!row.finished) std::printf("       %s\n", row.text.c_str());
  std::fflush(stdout);
}

// Where the millimetres of a garment's lines are.
void PrintZones(const Row& row) {
  for (const ZoneFit& zone : row.zones) {
    if (!zone.measured) continue;
    std::printf(
        "       %-6s %3.1f cm %-12s %-9s at %6.1f cm: body %7.1f flat %7.1f has to be %7.1f worn %7.1f mm, strain mean "
        "%4.1f %%, %3.0f %% on the body%s\n",
        row.body.c_str(), row.pitch_cm, row.garment.c_str(), std::string(FitZoneName(zone.zone)).c_str(),
        zone.height * 1e2, zone.body_girth * 1e3, zone.garment_girth * 1e3, zone.least_worn_girth * 1e3,
        zone.worn_girth * 1e3, zone.strain_mean * 1e2, zone.contact_share * 1e2, zone.is_belted ? ", belted" : "");
  }
}

void PrintSummary(const std::vector<Row>& rows, const Flags& flags) {
  std::printf("\n%-14s %9s %9s %9s %6s %12s %10s %9s %10s %11s %8s\n", "outfit", "garments", "finished", "stated",
              "torn", "deepest mm", "inside>0.1", "seam mm", "crossings", "ease max mm", "mean s");
  for (const std::string& outfit : flags.outfits) {
    int count = 0, finished = 0, stated = 0, torn = 0, inside = 0, crossings = 0;
    double deepest = 0.0, seam = 0.0, ease = 0.0, seconds = 0.0;
    for (const Row& row : rows) {
      if (row.outfit != outfit) continue;
      ++count;
      finished += row.finished;
      stated += row.stated;
      torn += row.torn;
      inside += row.deepest > 1e-4;
      crossings += row.crossings;
      deepest = std::max(deepest, row.deepest);
      if (row.finished) seam = std::max(seam, row.seam_max);
      ease = std::max(ease, row.ease_error);
      seconds += row.seconds;
    }
    std::printf("%-14s %9d %9d %9d %6d %12.3f %10d %9.3f %10d %11.1f %8.2f\n", outfit.c_str(), count, finished, stated,
                torn, deepest * 1e3, inside, seam * 1e3, crossings, ease * 1e3, count > 0 ? seconds / count : 0.0);
  }
}

// The girths of the worn garment on each mesh, and by how much they differ at most.
void PrintAgreement(const std::vector<Row>& rows, const Flags& flags) {
  std::printf("\n%-6s %-14s %-12s %-8s", "body", "outfit", "garment", "zone");
  for (const double pitch_cm : flags.pitches_cm) std::printf("  %4.1f cm", pitch_cm);
  std::printf("  differ by (mm)\n");
  double largest = 0.0;
  for (const Row& first : rows) {
    if (first.pitch_cm != flags.pitches_cm.front()) continue;
    for (size_t zone = 0; zone < first.zones.size(); ++zone) {
      std::vector<double> girths;
      for (const double pitch_cm : flags.pitches_cm) {
        for (const Row& row : rows) {
          const bool is_same = row.body == first.body && row.outfit == first.outfit && row.garment == first.garment;
          if (!is_same || row.pitch_cm != pitch_cm || zone >= row.zones.size()) continue;
          if (row.zones[zone].measured && row.zones[zone].worn_girth > 0.0)
            girths.push_back(row.zones[zone].worn_girth);
        }
      }
      if (girths.size() != flags.pitches_cm.size()) continue;
      const auto [least, most] = std::minmax_element(girths.begin(), girths.end());
      largest = std::max(largest, *most - *least);
      std::printf("%-6s %-14s %-12s %-8s", first.body.c_str(), first.outfit.c_str(), first.garment.c_str(),
                  std::string(FitZoneName(first.zones[zone].zone)).c_str());
      for (const double girth : girths) std::printf("  %7.1f", girth * 1e3);
      std::printf("  %5.1f\n", (*most - *least) * 1e3);
    }
  }
  std::printf("largest difference %.1f mm\n", largest * 1e3);
}

// The tables of ease, of the first mesh.
void PrintEase(const std::vector<Row>& rows, const Flags& flags) {
  std::vector<WornZones> worn;
  for (const Row& row : rows) {
    if (row.pitch_cm == flags.pitches_cm.front()) {
      worn.push_back({row.body, row.outfit, row.garment, row.size, row.zones, row.belt_ease});
    }
  }
  PrintEaseTable(worn);
  if (flags.all_sizes) PrintEaseOfSizes(worn);
}

// What a fit in the right size has to be; in another size it has to end with a stated outcome, whole and outside.
bool IsAsPromised(const Row& row, const Flags& flags) {
  if (!row.stated || row.torn || row.deepest > 1e-4) return false;
  return flags.step != 0 || flags.all_sizes || (row.finished && row.seam_max <= 5e-4);
}

// A scan that several threads dress: read by the first of them.
struct SharedBody {
  std::once_flag once;
  std::optional<Result<BodyInput>> scan;
  std::atomic<size_t> outfits_done = 0;
};

int Run(const Flags& flags) {
  std::map<std::string, GarmentInput> wardrobe;
  for (const std::string& outfit : flags.outfits) {
    for (const std::string& name : GarmentsOf(outfit)) {
      if (wardrobe.contains(name)) continue;
      Result<GarmentInput> garment = LoadGarment(std::filesystem::path(flags.garments) / name);
      if (!garment.ok()) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), garment.status().message().c_str());
        return 1;
      }
      ExtendChart(flags.step, garment->garment.chart);
      wardrobe.emplace(name, std::move(garment).value());
    }
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(flags.bodies)) {
    if (entry.path().extension() == ".ply") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::filesystem::path> chosen;
  for (size_t i = 0; i < files.size(); i += static_cast<size_t>(flags.every)) {
    const bool is_named = std::find(flags.names.begin(), flags.names.end(), files[i].stem()) != flags.names.end();
    if (flags.names.empty() || is_named) chosen.push_back(files[i]);
  }

  if (chosen.empty()) {
    std::fprintf(stderr, "no PLY in %s\n", flags.bodies.c_str());
    return 1;
  }

  std::vector<Row> all;
  std::mutex mutex;
  std::atomic<size_t> next = 0;
  const auto sizes_of = [&](const std::string& outfit) {
    std::vector<std::string> sizes;
    if (!flags.all_sizes) return std::vector<std::string>{""};
    for (const GarmentSize& size : wardrobe.at(GarmentsOf(outfit).back()).garment.chart.sizes) {
      sizes.push_back(size.name);
    }
    return sizes;
  };
  // A body's outfits are shared out one by one; the last of them lets go of the scan.
  std::vector<SharedBody> bodies(chosen.size());
  const size_t outfit_count = flags.outfits.size();
  const auto work = [&] {
    for (size_t i = next++; i < chosen.size() * outfit_count; i = next++) {
      const std::filesystem::path& file = chosen[i / outfit_count];
      const std::string& outfit = flags.outfits[i % outfit_count];
      SharedBody& shared = bodies[i / outfit_count];
      std::call_once(shared.once, [&] { shared.scan.emplace(LoadScan(file)); });
      const Result<BodyInput>& body = *shared.scan;
      if (!body.ok()) {
        Row row;
        row.body = file.stem().string();
        row.outfit = outfit;
        row.reason = body.status().reason();
        row.text = body.status().message();
        const std::lock_guard lock(mutex);
        PrintRow(row);
        all.push_back(row);
        continue;
      }
      for (const std::string& size : sizes_of(outfit)) {
        for (const double pitch_cm : flags.pitches_cm) {
          const std::vector<Row> rows = FitOne(file, *body, outfit, wardrobe, pitch_cm, size, flags);
          const std::lock_guard lock(mutex);
          for (const Row& row : rows) {
            PrintRow(row);
            if (flags.zones) PrintZones(row);
          }
          all.insert(all.end(), rows.begin(), rows.end());
        }
      }
      if (++shared.outfits_done == outfit_count) shared.scan.reset();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < flags.threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  PrintSummary(all, flags);
  PrintEase(all, flags);
  if (flags.pitches_cm.size() > 1) PrintAgreement(all, flags);
  const auto failed = std::count_if(all.begin(), all.end(), [&](const Row& row) { return !IsAsPromised(row, flags); });
  std::printf("\n%zu garments, %td not as promised\n", all.size(), failed);
  return flags.check && failed > 0 ? 1 : 0;
}

}  // namespace
}  // namespace fitroom

int main(int argc, char** argv) {
  fitroom::Flags flags;
  CLI::App app("Dresses a population in outfits and says how each fit ended");
  app.add_option("--bodies", flags.bodies, "Folder of PLY scans")->required()->check(CLI::ExistingDirectory);
  app.add_option("--garments", flags.garments, "Folder of garment folders")->required()->check(CLI::ExistingDirectory);
  app.add_option("--outfit", flags.outfits, "Garments joined by +, the innermost first; several times");
  app.add_option("--every", flags.every, "Only every n-th body")->check(CLI::Range(1, 1000));
  app.add_option("--step", flags.step, "So many sizes larger (or smaller) than the right one");
  app.add_flag("--all-sizes", flags.all_sizes,
               "Every size of the outermost garment's chart, and a table of their ease");
  app.add_option("--threads", flags.threads, "Fits at a time")->check(CLI::Range(1, 64));
  app.add_option("--pitch-cm", flags.pitches_cm,
                 "Edge length of the cloth meshes; several times: compares their girths");
  app.add_option("--body", flags.names, "Only bodies of this name; several times");
  app.add_flag("--zones", flags.zones, "A line a zone: what the girths are");
  app.add_flag("--one-mesh", flags.one_mesh, "Dress fine meshes without coarser ones first");
  app.add_flag("--no-self-collision", flags.no_self_collision, "Let cloth pass through itself");
  app.add_flag("--check", flags.check,
               "Fail where a fit is not as promised: finished, outside the body, closed, whole");
  CLI11_PARSE(app, argc, argv);
  return fitroom::Run(flags);
}
