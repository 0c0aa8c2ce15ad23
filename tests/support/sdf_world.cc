// Loads a world by libsdformat and prints what it found, a line of JSON each; usage: sdf_world FILE.sdf
#include <iostream>
#include <string>

#include <sdf/sdf.hh>

namespace
{
std::string Quoted(const std::string &_text)
{
  std::string quoted = "\"";
  for (const char sign : _text)
  {
    if (sign == '"' || sign == '\\')
      quoted += '\\';
    quoted += sign;
  }
  return quoted + '"';
}

template <typename Pose>
void PrintPose(const Pose &_pose)
{
  std::cout << ",\"move\":[" << _pose.Pos().X() << ',' << _pose.Pos().Y() << ',' << _pose.Pos().Z()
            << "],\"turn\":[" << _pose.Rot().X() << ',' << _pose.Rot().Y() << ',' << _pose.Rot().Z() << ','
            << _pose.Rot().W() << ']';
}

template <typename Part>
bool PrintPlaced(const std::string &_kind, const std::string &_model, const Part &_part, sdf::Errors &_errors)
{
  auto pose = _part.RawPose();
  for (const auto &error : _part.SemanticPose().Resolve(pose, "__model__"))
    _errors.push_back(error);
  std::cout << "{\"kind\":" << Quoted(_kind) << ",\"model\":" << Quoted(_model) << ",\"name\":" << Quoted(_part.Name());
  PrintPose(pose);
  return true;
}

void PrintGeometry(const sdf::Geometry &_geometry)
{
  if (const auto *box = _geometry.BoxShape())
  {
    std::cout << ",\"shape\":\"box\",\"size\":[" << box->Size().X() << ',' << box->Size().Y() << ','
              << box->Size().Z() << ']';
  }
  else if (const auto *cylinder = _geometry.CylinderShape())
  {
    std::cout << ",\"shape\":\"cylinder\",\"size\":[" << cylinder->Radius() << ',' << cylinder->Length() << ']';
  }
  else if (const auto *mesh = _geometry.MeshShape())
  {
    std::cout << ",\"shape\":\"mesh\",\"uri\":" << Quoted(mesh->Uri()) << ",\"submesh\":" << Quoted(mesh->Submesh())
              << ",\"scale\":[" << mesh->Scale().X() << ',' << mesh->Scale().Y() << ',' << mesh->Scale().Z() << ']';
  }
  std::cout << "}\n";
}
}  // namespace

int main(int, char **_arguments)
{
  sdf::Root root;
  auto errors = root.Load(_arguments[1]);
  std::cout.precision(12);
  if (errors.empty())
  {
    const auto *world = root.WorldByIndex(0);
    std::cout << "{\"kind\":\"world\",\"name\":" << Quoted(world->Name()) << ",\"version\":" << Quoted(root.Version())
              << ",\"worlds\":" << root.WorldCount() << ",\"physics\":" << world->PhysicsCount() << "}\n";
    for (uint64_t number = 0; number < world->ModelCount(); ++number)
    {
      const auto *model = world->ModelByIndex(number);
      auto place = model->RawPose();
      for (const auto &error : model->SemanticPose().Resolve(place))
        errors.push_back(error);
      std::cout << "{\"kind\":\"model\",\"name\":" << Quoted(model->Name())
                << ",\"static\":" << (model->Static() ? "true" : "false");
      PrintPose(place);
      std::cout << "}\n";
      const auto *link = model->LinkByIndex(0);
      for (uint64_t part = 0; part < link->CollisionCount(); ++part)
      {
        const auto *collision = link->CollisionByIndex(part);
        PrintPlaced("collision", model->Name(), *collision, errors);
        PrintGeometry(*collision->Geom());
      }
      for (uint64_t part = 0; part < link->VisualCount(); ++part)
      {
        const auto *visual = link->VisualByIndex(part);
        PrintPlaced("visual", model->Name(), *visual, errors);
        PrintGeometry(*visual->Geom());
      }
    }
    for (uint64_t number = 0; number < world->LightCount(); ++number)
    {
      const auto *light = world->LightByIndex(number);
      std::cout << "{\"kind\":\"light\",\"name\":" << Quoted(light->Name())
                << ",\"type\":" << static_cast<int>(light->Type()) << ",\"intensity\":" << light->Intensity()
                << ",\"range\":" << light->AttenuationRange() << ",\"quadratic\":" << light->QuadraticAttenuationFactor()
                << ",\"diffuse\":[" << light->Diffuse().R() << ',' << light->Diffuse().G() << ',' << light->Diffuse().B()
                << "],\"outer\":" << light->SpotOuterAngle().Radian() << ",\"direction\":[" << light->Direction().X()
                << ',' << light->Direction().Y() << ',' << light->Direction().Z() << ']';
      PrintPose(light->RawPose());
      std::cout << "}\n";
    }
    for (uint64_t number = 0; number < world->FrameCount(); ++number)
    {
      const auto *frame = world->FrameByIndex(number);
      auto place = frame->RawPose();
      for (const auto &error : frame->SemanticPose().Resolve(place))
        errors.push_back(error);
      std::cout << "{\"kind\":\"frame\",\"name\":" << Quoted(frame->Name());
      PrintPose(place);
      std::cout << "}\n";
    }
  }
  for (const auto &error : errors)
    std::cerr << error << '\n';
  return errors.empty() ? 0 : 1;
}
