// Colour and camera of a sample.

layout(location = 0) out vec4 colour;
layout(location = 1) out uint source;

flat in vec4 pointColour;
uniform uint sourceOfPiece;

void main() {
  colour = pointColour;
  source = sourceOfPiece;
}
