#include "rviz_panel/candidate_table.h"

#include <string>

#include "rviz_panel/cells.h"

namespace mocha {
namespace {

const QColor kDriven(190, 235, 180);
const QColor kOther(255, 255, 255);

std::string number(double value, int decimals) {
  return QString::number(value, 'f', decimals).toStdString();
}

/// What became of it, and the terms of its cost as a tip.
std::string verdict(const mocha_ugv::Candidate& candidate) {
  if (candidate.selected) return "driven";
  if (candidate.status.reason == mocha_ugv::PlannerStatus::SOLVED) return "certified";
  return candidate.status.message;
}

QString terms(const mocha_ugv::Candidate& candidate) {
  QString text;
  for (const auto& term : candidate.terms)
    text += QString::fromStdString(term.name + ": " + number(term.value, 2) + "\n");
  return text.trimmed();
}

}  // namespace

CandidateTable::CandidateTable(QWidget* parent) : QTableWidget(0, 5, parent) {
  setObjectName("classes");
  prepare(*this, {"Class", "Cost", "Time [s]", "Length [m]", ""});
  setSelectionMode(NoSelection);
}

void CandidateTable::show_candidates(const std::vector<mocha_ugv::Candidate>& candidates) {
  setRowCount(static_cast<int>(candidates.size()));
  int row = 0;
  for (const mocha_ugv::Candidate& candidate : candidates) {
    const QColor& colour = candidate.selected ? kDriven : kOther;
    const bool moves = candidate.duration > 0.0;
    set_cell(*this, row, 0, std::to_string(row + 1), colour);
    set_cell(*this, row, 1, moves ? number(candidate.cost, 1) : "", colour);
    set_cell(*this, row, 2, moves ? number(candidate.duration, 1) : "", colour);
    set_cell(*this, row, 3, moves ? number(candidate.length, 1) : "", colour);
    set_cell(*this, row, 4, verdict(candidate), colour);
    item(row, 1)->setToolTip(terms(candidate));
    ++row;
  }
}

}  // namespace mocha
