// Stand-ins for the classes of OpenSees that examples/opensees/FloorSlider.cpp uses, with the same signatures: enough to
// compile the element and to take it through the calls that a domain makes. tests/python/test_opensees.py writes a header
// of each name that includes this one.
#pragma once

#include <cstddef>
#include <iostream>
#include <vector>

class OPS_Stream {
 public:
  virtual ~OPS_Stream() = default;
  virtual int tag(const char*) { return 0; }
  virtual int tag(const char*, const char*) { return 0; }
  virtual int endTag() { return 0; }
  virtual OPS_Stream& operator<<(const char* s) { return std::cerr << s, *this; }
  virtual OPS_Stream& operator<<(int n) { return std::cerr << n, *this; }
};
inline OPS_Stream the_stream;
inline OPS_Stream& opserr = the_stream;

class Vector {
 public:
  Vector() = default;
  Vector(int size) : values_(static_cast<std::size_t>(size)) {}
  int Size() const { return static_cast<int>(values_.size()); }
  double& operator()(int i) { return values_.at(static_cast<std::size_t>(i)); }
  double operator()(int i) const { return values_.at(static_cast<std::size_t>(i)); }

 private:
  std::vector<double> values_;
};

class Matrix {
 public:
  Matrix() = default;
  Matrix(int rows, int columns) : size_(rows * columns) {}
  int size() const { return size_; }

 private:
  int size_ = 0;
};

class ID {
 public:
  ID(int size) : values_(static_cast<std::size_t>(size)) {}
  int& operator()(int i) { return values_.at(static_cast<std::size_t>(i)); }
  int operator()(int i) const { return values_.at(static_cast<std::size_t>(i)); }

 private:
  std::vector<int> values_;
};

class Channel {
 public:
  virtual ~Channel() = default;
  virtual int sendVector(int db_tag, int commit_tag, const Vector& vector) = 0;
  virtual int recvVector(int db_tag, int commit_tag, Vector& vector) = 0;
};
class FEM_ObjectBroker {};

class Information {
 public:
  int setVector(const Vector& vector) { return value = vector, 0; }
  Vector value;
};
class Response {
 public:
  virtual ~Response() = default;
  virtual int getResponse() = 0;
  Information information;
};

class Node {
 public:
  virtual ~Node() = default;
  virtual int getNumberDOF() const = 0;
  virtual const Vector& getTrialAccel() = 0;
  virtual const Vector& getRV(const Vector& ground) = 0;  // the ground's accelerations on its degrees of freedom
};
class Domain {
 public:
  virtual ~Domain() = default;
  virtual Node* getNode(int tag) = 0;
  virtual double getCurrentTime() const = 0;
};

class TaggedObject {
 public:
  TaggedObject(int tag) : tag_(tag) {}
  virtual ~TaggedObject() = default;
  int getTag() const { return tag_; }
  virtual void Print(OPS_Stream& s, int flag = 0) = 0;

 protected:
  void setTag(int tag) { tag_ = tag; }

 private:
  int tag_;
};
class MovableObject {
 public:
  MovableObject(int) {}
  virtual ~MovableObject() = default;
  int getDbTag() const { return 0; }
  virtual int sendSelf(int commit_tag, Channel& channel) = 0;
  virtual int recvSelf(int commit_tag, Channel& channel, FEM_ObjectBroker& broker) = 0;
};
class DomainComponent : public TaggedObject, public MovableObject {
 public:
  virtual void setDomain(Domain* domain) { domain_ = domain; }
  virtual Domain* getDomain() const { return domain_; }

 protected:
  DomainComponent(int tag, int class_tag) : TaggedObject(tag), MovableObject(class_tag) {}

 private:
  Domain* domain_ = nullptr;
};

class Element : public DomainComponent {
 public:
  Element(int tag, int class_tag) : DomainComponent(tag, class_tag) {}
  virtual int getNumExternalNodes() const = 0;
  virtual const ID& getExternalNodes() = 0;
  virtual Node** getNodePtrs() = 0;
  virtual int getNumDOF() = 0;
  virtual int commitState() { return 0; }
  virtual int revertToLastCommit() = 0;
  virtual int revertToStart() { return 0; }
  virtual int update() { return 0; }
  virtual const Matrix& getTangentStiff() = 0;
  virtual const Matrix& getInitialStiff() = 0;
  virtual void zeroLoad() {}
  virtual int addInertiaLoadToUnbalance(const Vector&) { return 0; }
  virtual const Vector& getResistingForce() = 0;
  virtual Response* setResponse(const char**, int, OPS_Stream&) { return nullptr; }
  virtual int getResponse(int, Information&) { return -1; }
};

class ElementResponse : public Response {
 public:
  ElementResponse(Element* element, int id, const Vector&) : element_(element), id_(id) {}
  int getResponse() override { return element_->getResponse(id_, information); }

 private:
  Element* element_;
  int id_;
};

extern "C" int OPS_GetNumRemainingInputArgs();
extern "C" int OPS_GetIntInput(int* count, int* data);
extern "C" int OPS_GetDoubleInput(int* count, double* data);
