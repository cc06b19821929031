#pragma once

#include <mocha_ugv/Candidate.h>

#include <QTableWidget>
#include <vector>

namespace mocha {

/// The classes of paths of a plan, with their costs; the one that is driven is marked.
class CandidateTable : public QTableWidget {
  Q_OBJECT

 public:
  explicit CandidateTable(QWidget* parent = nullptr);
  /// In this order.
  void show_candidates(const std::vector<mocha_ugv::Candidate>& candidates);
};

}  // namespace mocha
