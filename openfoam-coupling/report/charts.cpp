// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements charts.h with VTK.
#include "report/charts.h"

#include "report/picture_file.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace eccentra::report {
namespace {

using Colour = std::array<unsigned char, 3>;

/// Okabe and Ito's colours, which colour-blind readers tell apart.
constexpr std::array<Colour, 8> colours = {{{0, 114, 178},
                                            {213, 94, 0},
                                            {0, 158, 115},
                                            {204, 121, 167},
                                            {230, 159, 0},
                                            {86, 180, 233},
                                            {0, 0, 0},
                                            {150, 150, 150}}};
constexpr int title_size = 22;
constexpr int label_size = 18;

vtkSmartPointer<vtkDoubleArray> column(const std::string& name, const std::vector<double>& values, double scale = 1) {
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  for (const double value : values)
    array->InsertNextValue(value * scale);
  return array;
}

vtkSmartPointer<vtkChartXY> chart(vtkContextView& view, const std::string& title, const std::string& x,
                                  const std::string& y, const std::array<float, 4>& rectangle, bool legend) {
  const auto result = vtkSmartPointer<vtkChartXY>::New();
  view.GetScene()->AddItem(result);
  result->SetAutoSize(false);
  result->SetSize(vtkRectf(rectangle[0], rectangle[1], rectangle[2], rectangle[3]));
  result->SetTitle(title);
  result->GetTitleProperties()->SetFontSize(title_size);
  result->SetShowLegend(legend); // the colours of the cases are the same in all charts
  result->GetLegend()->SetLabelSize(label_size - 2);
  for (const auto& [axis, text] : {std::pair{vtkAxis::BOTTOM, x}, std::pair{vtkAxis::LEFT, y}}) {
    vtkAxis& a = *result->GetAxis(axis);
    a.SetTitle(text);
    a.GetTitleProperties()->SetFontSize(label_size);
    a.GetTitleProperties()->SetBold(false);
    a.GetLabelProperties()->SetFontSize(label_size - 2);
    a.GetGridPen()->SetColor(225, 225, 225);
  }
  return result;
}

void line(vtkChartXY& chart, const std::string& name, vtkDoubleArray* x, vtkDoubleArray* y, std::size_t colour) {
  const auto table = vtkSmartPointer<vtkTable>::New();
  y->SetName(name.c_str());
  table->AddColumn(x);
  table->AddColumn(y);
  vtkPlot* plot = chart.AddPlot(vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(name);
  const Colour& c = colours[colour % colours.size()];
  plot->SetColor(c[0], c[1], c[2], 255);
  constexpr float width = 2.5F;
  plot->SetWidth(width);
}

/// A column of coupling.csv over the time, without its first `skip` rows: the start is a jump that would set the scale.
void over_time(vtkChartXY& chart, const std::vector<Case>& cases, const char* name, double scale, std::size_t skip) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Table& run = cases[i].run;
    if (!run.has(name) || run.rows() <= skip)
      continue;
    const auto from = static_cast<std::ptrdiff_t>(skip);
    const auto& t = run.columns.at("time");
    const auto& v = run.columns.at(name);
    line(chart, cases[i].name, column("time", {t.begin() + from, t.end()}),
         column(name, {v.begin() + from, v.end()}, scale), i);
  }
}

} // namespace

void draw_charts(const std::vector<Case>& cases, const std::vector<Summary>& summaries,
                 const std::filesystem::path& folder) {
  constexpr float width = 1600;
  constexpr float height = 1200;
  constexpr float gap = 15;
  const auto view = vtkSmartPointer<vtkContextView>::New();
  view->GetRenderWindow()->SetOffScreenRendering(1);
  view->GetRenderWindow()->SetSize(static_cast<int>(width), static_cast<int>(height));
  view->GetRenderWindow()->SetMultiSamples(0); // the chart smooths its lines itself; more blurs its text
  view->GetRenderer()->SetBackground(1, 1, 1);
  const auto quarter = [&](float column_index, float row) {
    return std::array<float, 4>{gap + column_index * width / 2, gap + row * height / 2, width / 2 - 2 * gap,
                                height / 2 - 2 * gap};
  };

  const bool annuli = std::all_of(cases.begin(), cases.end(), [](const Case& c) { return c.is_annulus; });
  if (annuli) {
    const auto profile = chart(*view, "Solid over the height of the hole", "solid volume fraction",
                               "height / hole diameter", quarter(0, 1), true);
    for (std::size_t i = 0; i < summaries.size(); ++i) {
      std::vector<double> heights;
      for (std::size_t k = 0; k < summaries[i].profile.size(); ++k)
        heights.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(summaries[i].profile.size()));
      line(*profile, summaries[i].name, column("fraction", summaries[i].profile), column("height", heights), i);
    }
  } else {
    const auto height = chart(*view, "Centre of the solid", "time [s]", "z [mm]", quarter(0, 1), true);
    over_time(*height, cases, "com_z", 1000, 1);
  }
  const auto flux = chart(*view, annuli ? "Solid flux along the hole" : "Solid flux along z", "time [s]",
                          "flux [1e-6 m3/s]", quarter(1, 1), false);
  over_time(*flux, cases, "solids_flux", 1e6, 1);
  constexpr std::size_t start = 2;
  const auto gradient = chart(*view, "Pressure gradient that drives the flow", "time [s]", "pressure gradient [Pa/m]",
                              quarter(0, 0), false);
  over_time(*gradient, cases, "pressure_gradient", 1, start);

  const auto cost = chart(*view, "Where the wall-clock time goes", "", "seconds", quarter(1, 0), true);
  const auto table = vtkSmartPointer<vtkTable>::New();
  std::vector<double> places;
  const auto names = vtkSmartPointer<vtkStringArray>::New();
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    places.push_back(static_cast<double>(i));
    names->InsertNextValue(summaries[i].name);
  }
  const auto positions = column("case", places);
  table->AddColumn(positions);
  const std::size_t parts = summaries.empty() ? 0 : summaries[0].seconds.size();
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<double> seconds;
    for (const Summary& s : summaries)
      seconds.push_back(part < s.seconds.size() ? s.seconds[part].second : 0.0);
    table->AddColumn(column(summaries[0].seconds[part].first, seconds));
  }
  for (std::size_t part = 0; part < parts; ++part) {
    vtkPlot* plot = cost->AddPlot(vtkChart::BAR);
    plot->SetInputData(table, 0, static_cast<vtkIdType>(part) + 1);
    const Colour& c = colours[part];
    plot->SetColor(c[0], c[1], c[2], 255);
    plot->SetLabel(summaries[0].seconds[part].first);
  }
  vtkAxis& axis = *cost->GetAxis(vtkAxis::BOTTOM);
  axis.SetCustomTickPositions(positions, names);
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetRange(-0.6, static_cast<double>(summaries.size()) - 0.4);

  view->GetRenderWindow()->Render();
  write_png(*view->GetRenderWindow(), folder / "charts.png");
  const auto vectors = vtkSmartPointer<vtkSVGExporter>::New();
  const std::string path = (folder / "charts.svg").string();
  vectors->SetRenderWindow(view->GetRenderWindow());
  vectors->SetFileName(path.c_str());
  vectors->SetTitle("Eccentra: charts of a run");
  vectors->Write();
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error(path + ": cannot be written: check the folder and the space on the disk");
}

} // namespace eccentra::report
