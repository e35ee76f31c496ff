# Waits until the program has ended, for which it has ten seconds.
for _ in $(seq 220); do
  [ "$(halcmd getp rung.powered-off)" = TRUE ] && exit
  sleep 0.05
done
echo "the program has not ended" >&2
