// Sends the chosen file to the address of the uploader, and reports its state to the page.
(largest, address, emit) => async (event) => {
  const field = event.target, file = field.files[0];
  if (!file) return;
  if (file.size > largest) { emit({name: file.name, size: file.size}); field.value = ""; return; }
  const form = new FormData();
  form.append("file", file, file.name);
  emit({name: file.name, status: 0});
  try {
    const answer = await fetch(address, {method: "POST", body: form});
    if (!answer.ok) emit({name: file.name, status: answer.status});
  } catch (error) { emit({name: file.name, status: -1}); }
  field.value = "";
}
