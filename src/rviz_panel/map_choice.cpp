#include "rviz_panel/map_choice.h"

namespace mocha {

void show_map_of(const std::string& robot, rviz::DisplayGroup& displays) {
  for (int i = 0; i < displays.numDisplays(); ++i) {
    rviz::DisplayGroup* group = displays.getGroupAt(i);
    for (int j = 0; group && j < group->numDisplays(); ++j) {
      rviz::Display* display = group->getDisplayAt(j);
      if (display->getName() == "Map") display->setEnabled(group->getName().toStdString() == robot);
    }
  }
}

}  // namespace mocha
