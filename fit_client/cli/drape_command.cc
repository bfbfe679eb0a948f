#include <sys/resource.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "common/base/executor.h"
#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/base/progress.h"
#include "common/base/thread_count.h"
#include "common/scan_file/obj_writer.h"
#include "common/scan_file/scan_file.h"
#include "fit_client/cli/commands.h"
#include "fit_client/fit/collision/body_repair.h"
#include "fit_client/fit/solver/drape.h"

namespace fitroom::fit_client {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kReach = 0.12;             // The cloth never gets further than this beyond its start (unit: metre).
constexpr double kWrittenGap = 1e-4;        // Between sewn partners in the written OBJ (unit: metre).
constexpr double kBendingStiffness = 4e-5;  // A light woven: folds of some centimetres (unit: N m).
constexpr size_t kMaxSeamsSize = size_t{64} << 20;

struct DrapeFlags {
  std::string body;
  std::string panels;
  std::string seams;
  std::string out;
  std::string report;
  std::string up;
  int thread_count = 0;
};

// Seconds since it was made or last asked.
class Lap {
 public:
  double Take() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Reads lines of two vertex numbers, from 0; empty lines and lines that start with # are skipped.
Result<std::vector<SeamPair>> ReadSeams(const std::string& path, int vertex_count) {
  FR_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMaxSeamsSize));
  std::vector<SeamPair> seams;
  int line_number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    ++line_number;
    SeamPair pair;
    int* const targets[] = {&pair.a, &pair.b};
    size_t found = 0;
    while (true) {
      const size_t word = line.find_first_not_of(" \t\r");
      if (word == std::string_view::npos || line[word] == '#') break;
      line.remove_prefix(word);
      int value = -1;
      const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), value);
      if (error != std::errc() || found == 2 || value < 0 || value >= vertex_count) {
        return InvalidArgument("SEAMS_MALFORMED", path + ":" + std::to_string(line_number) +
                                                      ": expected two vertex numbers from 0 to " +
                                                      std::to_string(vertex_count - 1));
      }
      *targets[found++] = value;
      line.remove_prefix(static_cast<size_t>(rest - line.data()));
    }
    if (found == 1) {
      return InvalidArgument("SEAMS_MALFORMED", path + ":" + std::to_string(line_number) + ": a pair of one vertex");
    }
    if (found == 2) seams.push_back(pair);
  }
  if (seams.empty()) return InvalidArgument("SEAMS_MISSING", path + ": there are no seam pairs in this file");
  return seams;
}

// Which way is up: as said, or the taller of y and z, because a standing body is taller than deep.
Result<Eigen::Vector3d> FindUp(const std::string& flag, const TriangleMesh& body) {
  if (flag == "y") return Eigen::Vector3d(Eigen::Vector3d::UnitY());
  if (flag == "z") return Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  if (!flag.empty()) return InvalidArgument("UP_UNKNOWN", "--up takes y or z, not \"" + flag + "\"");
  const Eigen::Vector3d size = ComputeBounds(body).sizes();
  return Eigen::Vector3d(size.z() > size.y() ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY());
}

Json MakeReport(const DrapeReport& report, const Json& seconds, int thread_count, const ClothMesh& mesh,
                const TriangleMesh& body) {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  Json json;
  json["outcome"] = DrapeOutcomeName(report.outcome);
  json["finishing_reason"] = report.finishing_reason;
  json["body"] = {{"vertices", body.vertices.size()}, {"triangles", body.triangles.size()}};
  json["cloth"] = {{"particles", mesh.rest_positions.size()}, {"triangles", mesh.triangles.size()}};
  json["threads"] = thread_count;
  json["seconds"] = seconds;
  json["peak_rss_mb"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  json["substeps"] = {{"merging", report.merging_substeps}, {"draping", report.draping_substeps}};
  json["simulated_s"] = report.simulated_seconds;
  json["seams"] = {{"pairs", report.seam_pair_count},
                   {"open", report.open_seam_count},
                   {"gap_mean_mm", report.seam_gap_mean * 1e3},
                   {"gap_p95_mm", report.seam_gap_p95 * 1e3},
                   {"gap_max_mm", report.seam_gap_max * 1e3}};
  json["rest"] = {{"speed_p99_cm_s", report.speed_p99 * 1e2},
                  {"speed_max_cm_s", report.speed_max * 1e2},
                  {"share_at_rest", report.share_at_rest}};
  json["penetration"] = {{"particles_inside", report.particles_inside},
                         {"samples_inside", report.samples_inside},
                         {"deepest_mm", report.deepest_penetration * 1e3}};
  json["strain"] = {
      {"p50", report.strain_p50}, {"p95", report.strain_p95}, {"p99", report.strain_p99}, {"max", report.strain_max}};
  json["self_crossings"] = report.self_crossing_count;
  return json;
}

Status RunDrape(const DrapeFlags& flags) {
  Lap lap;
  Json seconds;
  ThreadPool executor(flags.thread_count > 0 ? flags.thread_count : AvailableThreadCount());
  ProgressBar bar;
  bar.Update("reading", 0.0);
  FR_ASSIGN_OR_RETURN(RawScan scan, ReadScanFile(flags.body));
  FR_ASSIGN_OR_RETURN(RawScan panels, ReadScanFile(flags.panels));
  ClothMesh mesh;
  mesh.rest_positions = std::move(panels.mesh.vertices);
  mesh.triangles = std::move(panels.mesh.triangles);
  FR_ASSIGN_OR_RETURN(mesh.seams, ReadSeams(flags.seams, static_cast<int>(mesh.rest_positions.size())));
  FR_ASSIGN_OR_RETURN(const Eigen::Vector3d up, FindUp(flags.up, scan.mesh));
  seconds["read"] = lap.Take();

  bar.Update("measuring the body", 0.05);
  FR_ASSIGN_OR_RETURN(const TriangleMesh body, RepairBody(scan.mesh));
  Eigen::AlignedBox3d reach;
  for (const Eigen::Vector3d& position : mesh.rest_positions) reach.extend(position);
  SignedDistanceFieldOptions field_options;
  field_options.region = Eigen::AlignedBox3d(reach.min().array() - kReach, reach.max().array() + kReach);
  FR_ASSIGN_OR_RETURN(const SignedDistanceField field, SignedDistanceField::Build(body, field_options, executor));
  seconds["body_field"] = lap.Take();

  DrapeOptions options;
  options.gravity = -9.81 * up;
  options.material.bending_stiffness = kBendingStiffness;
  const DrapeObserver observer = [&](const DrapeSnapshot& snapshot) {
    bar.Update(DrapeStageName(snapshot.stage), 0.1 + 0.85 * snapshot.progress);
  };
  FR_ASSIGN_OR_RETURN(const DrapeResult result, Drape(mesh, mesh.rest_positions, field, options, executor, observer));
  seconds["drape"] = lap.Take();

  TriangleMesh draped;
  draped.vertices = SeparateSeamPartners(mesh, result.positions, kWrittenGap);
  draped.triangles = mesh.triangles;
  FR_RETURN_IF_ERROR(WriteFileAtomically(flags.out, FormatObj(draped)));
  seconds["write"] = lap.Take();
  if (!flags.report.empty()) {
    const Json report = MakeReport(result.report, seconds, executor.thread_count(), mesh, body);
    FR_RETURN_IF_ERROR(WriteFileAtomically(flags.report, report.dump(2) + "\n"));
  }
  std::printf("%s\n", result.report.finishing_reason.c_str());
  if (result.report.outcome != DrapeOutcome::kAtRest) {
    return FailedPrecondition("CLOTH_NOT_AT_REST", result.report.finishing_reason);
  }
  return Status();
}

}  // namespace

void AddDrapeCommand(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<DrapeFlags>();
  CLI::App* const command =
      app.add_subcommand("drape", "Sew given panels onto each other round a given body and let them come to rest");
  command->add_option("--body", flags->body, "Body mesh in metres: OBJ, PLY or ASE, also zstd-compressed")->required();
  command->add_option("--panels", flags->panels, "Flat panels at their start positions, in metres: OBJ")->required();
  command->add_option("--seams", flags->seams, "Vertex pairs to sew, two numbers from 0 a line")->required();
  command->add_option("--out", flags->out, "OBJ to write, vertices in the order of the panels")->required();
  command->add_option("--report", flags->report, "JSON report to write");
  command->add_option("--threads", flags->thread_count, "Threads to use; 0: all that are available")
      ->check(CLI::Range(0, 256));
  command->add_option("--up", flags->up, "The axis that points up, y or z; default: the taller one of the body");
  command->callback([flags, &exit_code] { exit_code = ReportAndExitCode("fit_client", RunDrape(*flags)); });
}

}  // namespace fitroom::fit_client
