// Takes examples/opensees/FloorSlider.cpp through an analysis as OpenSees's domain does, with stand-ins for its classes.
//
//     drive TAG NODE DOF SLIP_LEVEL [FREQUENCY DAMPING] < steps
//
// Each step is its time, the relative acceleration of the floor and that of the ground. Prints the response of each.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "opensees.h"

extern "C" void* OPS_FloorSlider();

static std::vector<double> given;  // the arguments of the command that are left
extern "C" int OPS_GetNumRemainingInputArgs() { return static_cast<int>(given.size()); }
extern "C" int OPS_GetDoubleInput(int* count, double* data) {
  for (int i = 0; i < *count; ++i, given.erase(given.begin())) {
    if (given.empty()) return -1;
    data[i] = given.front();
  }
  return 0;
}
extern "C" int OPS_GetIntInput(int* count, int* data) {
  for (int i = 0; i < *count; ++i) {
    double number;
    int one = 1;
    if (OPS_GetDoubleInput(&one, &number) != 0) return -1;
    data[i] = static_cast<int>(number);
  }
  return 0;
}

// Two degrees of freedom; the ground moves along the second.
struct Floor : Node, Domain {
  Vector acceleration{2}, of_ground{2};
  double time = 0;
  int getNumberDOF() const override { return 2; }
  const Vector& getTrialAccel() override { return acceleration; }
  const Vector& getRV(const Vector& ground) override { return of_ground(1) = ground(0), of_ground; }
  Node* getNode(int tag) override { return tag == 7 ? this : nullptr; }
  double getCurrentTime() const override { return time; }
};

struct Wire : Channel {
  Vector sent;
  int sendVector(int, int, const Vector& vector) override { return sent = vector, 0; }
  int recvVector(int, int, Vector& vector) override { return vector = sent, 0; }
};

static void trial(Element& element, Floor& floor, double time, double relative, double ground) {
  Vector of_ground(1);
  of_ground(0) = ground;
  floor.time = time;
  element.zeroLoad();
  element.addInertiaLoadToUnbalance(of_ground);
  for (double part : {0.3, 1.2, 1.0}) {  // iterations
    floor.acceleration(1) = part * relative;
    element.update();
    element.getResistingForce();
  }
}

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) given.push_back(std::atof(argv[i]));
  std::unique_ptr<Element> element(static_cast<Element*>(OPS_FloorSlider()));
  if (!element) return EXIT_FAILURE;
  Floor floor;
  element->setDomain(&floor);
  if (element->getNumDOF() != 2 || element->getTangentStiff().size() != 4) return EXIT_FAILURE;
  const char* name = "slide";
  double time, relative, ground;
  for (int step = 0; std::scanf("%lf %lf %lf", &time, &relative, &ground) == 3; ++step) {
    const double before = floor.time;
    trial(*element, floor, time + 0.01, -relative, 5 + ground);  // a step that does not converge
    element->revertToLastCommit();
    floor.time = before;
    trial(*element, floor, time, relative, ground);
    if (element->commitState() != 0) return EXIT_FAILURE;
    std::unique_ptr<Response> response(element->setResponse(&name, 1, opserr));
    response->getResponse();
    const Vector& slide = response->information.value;
    std::printf("%.17g %.17g %g\n", slide(0), slide(1), slide(2));
    if (step == 50) {  // to another process
      Wire wire;
      FEM_ObjectBroker broker;
      element->sendSelf(0, wire);
      element.reset(static_cast<Element*>(OPS_FloorSlider()));  // no arguments are left
      element->recvSelf(0, wire, broker);
      element->setDomain(&floor);
    }
  }
  return EXIT_SUCCESS;
}
