// Speed of reading and writing scans and of the codecs, on a body-sized mesh that the benchmark makes itself.
#include <string>

#include <benchmark/benchmark.h>

#include "common/codec/crc32c.h"
#include "common/codec/hash.h"
#include "common/codec/packed_mesh.h"
#include "common/codec/zstd.h"
#include "common/scan_file/ase_writer.h"
#include "common/scan_file/obj_writer.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom {
namespace {

// 120,001 vertices less one ring, 239,600 triangles.
const TriangleMesh& Mesh() {
  static const TriangleMesh mesh = testing::MakeSphere(301, 400);
  return mesh;
}

// About 100 MB with normals and texture.
const std::string& Ase() {
  static const std::string text = FormatAse(Mesh(), testing::MakeTexturedContent(Mesh()));
  return text;
}

void CountBytes(benchmark::State& state, size_t size) {
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(size));
}

void BM_ReadAse(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ReadScan(Ase(), "bench.ase").ok());
  CountBytes(state, Ase().size());
}
BENCHMARK(BM_ReadAse)->Unit(benchmark::kMillisecond);

void BM_WriteAse(benchmark::State& state) {
  const AseContent content = testing::MakeTexturedContent(Mesh());
  for (auto _ : state) benchmark::DoNotOptimize(FormatAse(Mesh(), content).size());
  CountBytes(state, Ase().size());
}
BENCHMARK(BM_WriteAse)->Unit(benchmark::kMillisecond);

void BM_ReadObj(benchmark::State& state) {
  const std::string text = FormatObj(Mesh());
  for (auto _ : state) benchmark::DoNotOptimize(ReadScan(text, "bench.obj").ok());
  CountBytes(state, text.size());
}
BENCHMARK(BM_ReadObj)->Unit(benchmark::kMillisecond);

void BM_PackMesh(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(PackMesh(Mesh()).ok());
}
BENCHMARK(BM_PackMesh)->Unit(benchmark::kMillisecond);

void BM_UnpackMesh(benchmark::State& state) {
  const std::string packed = *PackMesh(Mesh());
  for (auto _ : state) benchmark::DoNotOptimize(UnpackMesh(packed).ok());
}
BENCHMARK(BM_UnpackMesh)->Unit(benchmark::kMillisecond);

void BM_ZstdCompress(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ZstdCompress(Ase()).size());
  CountBytes(state, Ase().size());
}
BENCHMARK(BM_ZstdCompress)->Unit(benchmark::kMillisecond);

void BM_Blake2b(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Blake2b(Ase()));
  CountBytes(state, Ase().size());
}
BENCHMARK(BM_Blake2b)->Unit(benchmark::kMillisecond);

void BM_Crc32c(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Crc32c(Ase()));
  CountBytes(state, Ase().size());
}
BENCHMARK(BM_Crc32c)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fitroom
