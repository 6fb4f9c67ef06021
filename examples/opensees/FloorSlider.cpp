// An element for OpenSees: a block that slides on a floor, moved by the acceleration that each committed step gives the
// floor's node.
//
//     element FloorSlider $tag $node $dof $slipLevel <$naturalFrequency $damping>
//     recorder Element -file slide.out -time -ele $tag slide          displacement, velocity, mode
//
// $slipLevel is the coefficient of friction times g, in the units of the model; $naturalFrequency and $damping are those of
// a spring and a damper to the floor, as in stickslip/stickslip.h, by default none. Stops and static friction are members
// of the same struct.
//
// The coupling is one way: the element has no mass, stiffness or force, so that the block does not act back on the
// structure. It is for equipment and contents whose mass is small beside the floor's, not for isolators.
#include <Channel.h>
#include <Domain.h>
#include <Element.h>
#include <ElementResponse.h>
#include <FEM_ObjectBroker.h>
#include <ID.h>
#include <Information.h>
#include <Matrix.h>
#include <Node.h>
#include <OPS_Globals.h>
#include <Vector.h>
#include <elementAPI.h>
#include <stickslip/stickslip.h>

#include <cstring>

class FloorSlider : public Element {
 public:
  // dof: of the floor's motion, counted from 0.
  FloorSlider(int tag, int node, int dof, const stickslip_slider& slider)
      : Element(tag, 0), nodes_(1), dof_(dof), slider_(slider), slide_(3) {
    nodes_(0) = node;
  }
  FloorSlider() : FloorSlider(0, 0, 0, {}) {}  // for recvSelf

  int getNumExternalNodes() const override { return 1; }
  const ID& getExternalNodes() override { return nodes_; }
  Node** getNodePtrs() override { return &node_; }
  int getNumDOF() override { return zero_.Size(); }

  void setDomain(Domain* domain) override {
    node_ = domain ? domain->getNode(nodes_(0)) : nullptr;
    if (!node_) return;
    const int dofs = node_->getNumberDOF();
    if (dof_ < 0 || dof_ >= dofs) {
      opserr << "WARNING FloorSlider " << getTag() << ": its node has " << dofs << " degrees of freedom\n";
      node_ = nullptr;
      return;
    }
    zero_ = Vector(dofs);
    no_stiffness_ = Matrix(dofs, dofs);
    time_ = domain->getCurrentTime();
    DomainComponent::setDomain(domain);
  }

  // What the floor feels: nothing.
  const Matrix& getTangentStiff() override { return no_stiffness_; }
  const Matrix& getInitialStiff() override { return no_stiffness_; }
  const Vector& getResistingForce() override { return zero_; }

  // With UniformExcitation the accelerations of nodes are relative to the ground, whose own comes here, once per step.
  // With other patterns they are absolute, and the ground's remains 0.
  void zeroLoad() override { ground_ = 0; }
  int addInertiaLoadToUnbalance(const Vector& acceleration) override {
    if (node_) ground_ += node_->getRV(acceleration)(dof_);
    return 0;
  }

  // The only place where the block moves: trial steps and iterations leave it alone.
  int commitState() override {
    if (!node_) return -1;
    const double time = getDomain()->getCurrentTime();
    const double floor = node_->getTrialAccel()(dof_) + ground_;
    const stickslip_segment segment = {time - time_, floor_, floor, 0, 0};
    if (stickslip_advance(&slider_, &segment, &state_) != STICKSLIP_OK) {
      opserr << "WARNING FloorSlider " << getTag() << ": " << stickslip_message() << "\n";
      return -1;
    }
    time_ = time;
    floor_ = floor;
    return Element::commitState();
  }
  int revertToLastCommit() override { return 0; }
  int revertToStart() override {
    state_ = {};
    time_ = floor_ = ground_ = 0;
    return 0;
  }

  Response* setResponse(const char** argv, int argc, OPS_Stream& output) override {
    if (argc < 1 || std::strcmp(argv[0], "slide") != 0) return Element::setResponse(argv, argc, output);
    output.tag("ElementOutput");
    for (const char* name : {"displacement", "velocity", "mode"}) output.tag("ResponseType", name);
    output.endTag();
    return new ElementResponse(this, 1, slide_);
  }
  int getResponse(int id, Information& information) override {
    if (id != 1) return Element::getResponse(id, information);
    slide_(0) = state_.displacement;
    slide_(1) = state_.velocity;
    slide_(2) = state_.mode;
    return information.setVector(slide_);
  }

  int sendSelf(int commit, Channel& channel) override {
    Vector data(11);
    data(0) = getTag();
    data(1) = nodes_(0);
    data(2) = dof_;
    for (int i = 0; i < 8; ++i) data(3 + i) = *numbers_[i];
    return channel.sendVector(getDbTag(), commit, data);
  }
  int recvSelf(int commit, Channel& channel, FEM_ObjectBroker&) override {
    Vector data(11);
    if (channel.recvVector(getDbTag(), commit, data) < 0) return -1;
    setTag(static_cast<int>(data(0)));
    nodes_(0) = static_cast<int>(data(1));
    dof_ = static_cast<int>(data(2));
    for (int i = 0; i < 8; ++i) *numbers_[i] = data(3 + i);
    return 0;
  }
  void Print(OPS_Stream& s, int) override { s << "FloorSlider " << getTag() << " on node " << nodes_(0) << "\n"; }

 private:
  ID nodes_;
  int dof_;
  stickslip_slider slider_;
  Node* node_ = nullptr;
  double time_ = 0, floor_ = 0;  // of the last commit; the floor's acceleration is absolute
  double ground_ = 0;            // ground acceleration of this step
  stickslip_state state_ = {};
  Vector zero_, slide_;
  Matrix no_stiffness_;
  double* const numbers_[8] = {&slider_.slip_level,
                               &slider_.natural_frequency,
                               &slider_.damping,
                               &state_.displacement,
                               &state_.velocity,
                               &state_.mode,
                               &time_,
                               &floor_};
};

// Reads the command `element FloorSlider ...`.
extern "C" void* OPS_FloorSlider() {
  const int arguments = OPS_GetNumRemainingInputArgs();
  if (arguments == 0) return new FloorSlider();  // parallel processing
  int tags[3], three = 3;
  double numbers[3] = {};
  int rest = arguments - 3;
  if (rest < 1 || rest > 3 || OPS_GetIntInput(&three, tags) != 0 || OPS_GetDoubleInput(&rest, numbers) != 0) {
    opserr << "WARNING want: element FloorSlider tag? node? dof? slipLevel? <naturalFrequency? damping?>\n";
    return nullptr;
  }
  stickslip_slider slider = {};
  slider.slip_level = numbers[0];
  slider.natural_frequency = numbers[1];
  slider.damping = numbers[2];
  if (stickslip_check(&slider) != STICKSLIP_OK) {
    opserr << "WARNING FloorSlider " << tags[0] << ": " << stickslip_message() << "\n";
    return nullptr;
  }
  return new FloorSlider(tags[0], tags[1], tags[2] - 1, slider);
}
