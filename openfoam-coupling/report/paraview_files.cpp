// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One .vtm a time, which names its blocks; a .pvd names the times.
#include "report/paraview_files.h"

#include "report/body_surfaces.h"
#include "report/escaped.h"
#include "report/flow_fields.h"
#include "report/scene_picture.h"
#include "report/wall_surfaces.h"

#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace eccentra::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTriangles = 300000; // of the bodies of one time

/// A block of a .vtm: its name and the file's.
struct Block {
  std::string name;
  std::string file;
};

[[noreturn]] void not_written(const fs::path& file) {
  throw std::runtime_error(file.string() + ": cannot be written: check the folder and the space on the disk");
}

template <class Writer, class Data> void write_data(Data& data, const fs::path& file) {
  const auto writer = vtkSmartPointer<Writer>::New();
  writer->SetFileName(file.c_str());
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
    not_written(file);
}

void write_text(const std::string& text, const fs::path& file) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream)
    not_written(file);
}

std::string data_set(std::size_t index, const Block& block) {
  return fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", index, escaped(block.name),
                     escaped(block.file));
}

std::string multi_block(const std::vector<Block>& blocks, const std::vector<Block>& walls) {
  std::string text = "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n<vtkMultiBlockDataSet>\n";
  std::size_t index = 0;
  for (const Block& block : blocks)
    text += data_set(index++, block);
  if (!walls.empty()) {
    text += fmt::format("<Block index=\"{}\" name=\"walls\">\n", index);
    for (std::size_t k = 0; k < walls.size(); ++k)
      text += data_set(k, walls[k]);
    text += "</Block>\n";
  }
  return text + "</vtkMultiBlockDataSet>\n</VTKFile>\n";
}

/// Of the script's box; without one, of the bodies of the last file.
std::array<double, 6> box_of(const Case& data, vtkPolyData& last) {
  std::array<double, 6> box = data.dem.box;
  if (!data.dem.has_box)
    last.GetBounds(box.data());
  return box;
}

/// Files of a run that are written once.
class Folder {
 public:
  Folder(const Case& data, fs::path folder) : data_(data), folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }

  std::vector<Block> walls(const std::array<double, 6>& box) const {
    std::vector<Block> blocks;
    for (const WallSurface& wall : wall_surfaces(data_, box)) {
      blocks.push_back({wall.name, "wall_" + wall.name + ".vtp"});
      write_data<vtkXMLPolyDataWriter>(*wall.surface, folder_ / blocks.back().file);
    }
    return blocks;
  }

  Block points(const char* name, vtkPolyData& points, long step) const {
    const Block block{name, fmt::format("{}_{}.vtp", name, step)};
    write_data<vtkXMLPolyDataWriter>(points, folder_ / block.file);
    return block;
  }

  /// The fields next to a time, if there are any.
  std::vector<Block> fluid(double time) {
    if (times_.empty())
      return {};
    const double chosen = *std::min_element(
        times_.begin(), times_.end(), [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
    const auto [file, fresh] = fluids_.try_emplace(chosen);
    if (fresh)
      if (const auto grid = read_all_fields(data_.folder, chosen)) {
        file->second = fmt::format("fluid_{:.10g}.vtu", chosen);
        write_data<vtkXMLUnstructuredGridWriter>(*grid, folder_ / file->second);
      }
    return file->second.empty() ? std::vector<Block>{} : std::vector<Block>{{"fluid", file->second}};
  }

  void multi_block_file(const std::string& name, const std::vector<Block>& blocks,
                        const std::vector<Block>& walls) const {
    write_text(multi_block(blocks, walls), folder_ / name);
  }

 private:
  const Case& data_;
  fs::path folder_;
  std::vector<double> times_ = flow_times(data_.folder);
  std::map<double, std::string> fluids_;
};

} // namespace

fs::path write_paraview(const Case& data, const fs::path& folder) {
  if (data.spheres.empty())
    throw std::runtime_error(data.folder.string() + ": no files of particles: dump cluster/vtk or custom/vtk to "
                                                    "postProcessing/eccentra/grains_*.vtp or particles_*.vtk");
  Folder files(data, folder / data.name);
  const auto last = read_points(data.spheres.back().path);
  BodySurfaces surfaces(*last, kMostTriangles);
  const std::vector<Block> walls = files.walls(box_of(data, *last));
  std::string collection = "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const ParticleFile& file : data.spheres) {
    // Without a time step in the log, the steps stand for seconds.
    const double time = data.dem.time_step > 0 ? time_of(data, file) : static_cast<double>(file.step);
    const auto spheres = read_points(file.path);
    std::vector<Block> blocks = {files.points("bodies", *surfaces.of(*spheres), file.step)};
    for (const ParticleFile& body : data.bodies)
      if (body.step == file.step)
        blocks.push_back(files.points("particles", *read_points(body.path), file.step));
    for (const Block& block : files.fluid(std::max(0.0, time)))
      blocks.push_back(block);
    const std::string name = fmt::format("{}.vtm", file.step);
    files.multi_block_file(name, blocks, walls);
    collection +=
        fmt::format("<DataSet timestep=\"{:.10g}\" part=\"0\" file=\"{}\"/>\n", time, escaped(data.name + "/" + name));
  }
  const fs::path path = folder / (data.name + ".pvd");
  write_text(collection + "</Collection>\n</VTKFile>\n", path);
  return path;
}

} // namespace eccentra::report
