// Copies the link to an address, and says whether the browser allowed it: other machines need a secure connection
// for it, and browsers may ask their user first.
async (address) => {
  const link = window.location.origin + address;
  const board = navigator.clipboard;
  const copied = board ? board.writeText(link).then(() => true, () => false) : false;
  const asking = new Promise((done) => setTimeout(() => done(false), 3000));
  return [link, await Promise.race([copied, asking])];
}
