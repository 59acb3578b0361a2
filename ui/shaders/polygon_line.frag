flat in vec4 vColour;
flat in float vHalf;
in float vAcross;
out vec4 colour;

void main() { colour = vec4(vColour.rgb, vColour.a * clamp(vHalf + 0.5 - abs(vAcross), 0.0, 1.0)); }
